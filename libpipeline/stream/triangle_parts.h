#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/triangle_source.h"

namespace pipeline {

/// Has the text of triangles read by several threads, part by part. What a part's lines and triangles are
/// counted from is known when those before it are read: each thread waits for that, for a moment, if it has
/// to. If a part proves to hold something else, or a mistake, neither it nor any part behind it is read: the
/// owner puts them back, and the source reads them in order.
///
/// The owner takes parts, puts them back and closes; any thread reads.
class TriangleParts {
 public:
  /// Parts have about `part_size` characters, or fewer where no more is waiting.
  TriangleParts(TriangleSource& source, std::size_t part_size) : source_(source), part_size_(part_size) {}

  /// Takes the next part. False if the source has none or had better read for a while: then close(), and let
  /// it.
  bool take(TrianglePart& part, TriangleBatch& batch);
  /// Reads a part into the batch it was taken with. False if it, or one before it, holds anything but
  /// triangles. Parts have to be begun in the order in which they were taken.
  bool read(TrianglePart& part, TriangleBatch& batch);
  /// Puts back a part that could not be read, the last one first.
  void put_back(const TrianglePart& part);
  /// To be called when every part that was taken is read or put back: then the source may be asked again.
  void close();

  /// Whether parts were taken since the last close().
  [[nodiscard]] bool is_open() const { return is_open_; }

 private:
  TriangleSource& source_;
  std::size_t part_size_;
  // The owner's.
  bool is_open_ = false;
  std::uint64_t taken_count_ = 0;
  // How many lines are read in order before parts are taken again, and from which line on they are.
  static constexpr std::size_t kShortestPause = std::size_t{1} << 12;
  static constexpr std::size_t kLongestPause = std::size_t{1} << 16;
  std::size_t pause_ = kShortestPause;
  std::size_t first_line_ = 0;
  // Of whoever has the turn, or of the owner, if no part is being read.
  StreamPosition location_;  // where the next part begins
  bool is_broken_ = false;   // there is more than triangles
  std::atomic<std::uint64_t> turn_ = 0;
};

}  // namespace pipeline
