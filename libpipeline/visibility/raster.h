#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/memory.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// A two-dimensional array, row after row; row 0 is at the top, column 0 on the left. It may hold only some
/// rows of a picture; they keep their numbers.
template <typename T>
class Raster {
 public:
  /// An array whose entries are `value`; both sizes are at least 0.
  Raster(const RowRange& rows, int columns, const T& value)
      : rows_(rows), columns_(columns), entries_(count(rows, columns), value) {}
  /// An array of uninitialized entries: to read one before it is written is undefined. The system provides
  /// memory only where something is written.
  Raster(const RowRange& rows, int columns)
      : rows_(rows), columns_(columns), entries_(count(rows, columns)) {}

  /// The rows' numbers in the picture.
  [[nodiscard]] const RowRange& row_range() const { return rows_; }
  [[nodiscard]] int columns() const { return columns_; }

  [[nodiscard]] std::span<T> row(int row) { return {&entries_[begin(row)], width()}; }
  [[nodiscard]] std::span<const T> row(int row) const { return {&entries_[begin(row)], width()}; }

 private:
  static std::size_t count(const RowRange& rows, int columns) {
    return static_cast<std::size_t>(rows.end - rows.first) * static_cast<std::size_t>(columns);
  }
  [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(columns_); }
  [[nodiscard]] std::size_t begin(int row) const {
    assert(row >= rows_.first && row < rows_.end);
    return static_cast<std::size_t>(row - rows_.first) * width();
  }

  RowRange rows_;
  int columns_;
  std::vector<T, LargePageAllocator<T>> entries_;
};

/// One row of a visibility algorithm's result: for every column, the depth (NDC z) and the tag of the nearest
/// triangle, or the rear limit and the background's tag. Depth text and image are made from these rows alone.
struct VisibleRow {
  std::span<const double> depths;
  std::span<const PixelTag> tags;
};

/// A batch of triangles to be drawn, and a tag for each.
struct TaggedBatch {
  TriangleBatch batch;
  std::vector<PixelTag> tags;
};

/// Triangle `index` of a batch in NDC; refers to the batch.
inline ExactTriangle exact_triangle(const TriangleBatch& batch, std::size_t index) {
  return {batch.triangles[index], batch.low_parts.empty() ? nullptr : &batch.low_parts[index],
          batch.decimal_marks.empty() ? std::uint16_t{0} : batch.decimal_marks[index]};
}

}  // namespace pipeline
