#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "libpipeline/stream/triangle_parts.h"
#include "libpipeline/stream/triangle_source.h"

namespace pipeline {

/// A source's triangles, read by parts, three at a time, by one thread.
class ByParts {
 public:
  ByParts(TriangleSource& source, std::size_t part_size) : source_(source), parts_(source, part_size) {}

  /// See TriangleSource::read.
  bool read(TriangleBatch& batch) {
    if (next_ == read_count_) take_parts();
    if (next_ < read_count_) {
      std::swap(batch, batches_[next_++]);
      return true;
    }
    parts_.close();
    return source_.read(batch);
  }
  /// How many parts could be read.
  [[nodiscard]] int part_count() const { return part_count_; }

 private:
  void take_parts() {
    std::size_t taken_count = 0;
    while (taken_count < taken_.size() && parts_.take(taken_[taken_count], batches_[taken_count]))
      ++taken_count;
    next_ = read_count_ = 0;
    // When one could not be read, none behind it can.
    for (std::size_t i = 0; i < taken_count; ++i)
      if (parts_.read(taken_[i], batches_[i])) read_count_ = i + 1;
    for (std::size_t i = taken_count; i-- > read_count_;) parts_.put_back(taken_[i]);
    part_count_ += static_cast<int>(read_count_);
  }

  TriangleSource& source_;
  TriangleParts parts_;
  std::array<TrianglePart, 3> taken_;
  std::array<TriangleBatch, 3> batches_;
  std::size_t read_count_ = 0;
  std::size_t next_ = 0;
  int part_count_ = 0;
};

}  // namespace pipeline
