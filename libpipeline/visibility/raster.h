#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "libpipeline/stream/large_pages.h"

namespace pipeline {

/// A two-dimensional array, row after row; row 0 is at the top, column 0 on the left.
template <typename T>
class Raster {
 public:
  /// `rows` x `columns` entries of `value`; both sizes are at least 0.
  Raster(int rows, int columns, const T& value)
      : rows_(rows),
        columns_(columns),
        entries_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns), value) {}
  /// Entries without values: reading one before it is written is undefined. Where nothing is written, the
  /// system provides no memory.
  Raster(int rows, int columns)
      : rows_(rows),
        columns_(columns),
        entries_(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns)) {}

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int columns() const { return columns_; }

  [[nodiscard]] std::span<T> row(int row) { return {&entries_[begin(row)], width()}; }
  [[nodiscard]] std::span<const T> row(int row) const { return {&entries_[begin(row)], width()}; }

 private:
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(columns_); }
  [[nodiscard]] std::size_t begin(int row) const {
    assert(row >= 0 && row < rows_);
    return static_cast<std::size_t>(row) * width();
  }

  int rows_;
  int columns_;
  std::vector<T, LargePageAllocator<T>> entries_;
};

}  // namespace pipeline
