#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string_view>
#include <vector>

#include "libpipeline/stream/chunked_array.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/large_pages.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// The texts of triangles, under the ids 0, 1, 2 ...
class TextStore {
 public:
  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  /// The number in the scene of a triangle.
  [[nodiscard]] std::uint64_t number(KeptIds::Id id) const { return entries_[id].number; }

  /// Adds the triangles of a batch with texts.
  void add(const TriangleBatch& batch);
  /// Keeps this one for good.
  void keep_always(KeptIds::Id id) { entries_[id].is_needed = true; }
  /// Adds to those kept the needed ones, and the other pieces of each triangle: a wireframe asks a piece's
  /// neighbors which of its edges are cuts. Pieces follow one another with one number.
  void complete(KeptIds& kept) const;
  /// Keeps those that are kept, under their new ids.
  void keep(const KeptIds& kept);
  /// The first piece of the last triangle, of which more may follow.
  [[nodiscard]] KeptIds::Id begin_of_last() const;
  /// Writes those kept as the body of a stage text.
  void write(TextWriter& text, const KeptIds& kept) const;

 private:
  struct Entry {
    std::uint64_t number;
    std::uint32_t length;  // of the text
    bool is_needed;
  };

  using Block = std::vector<char, LargePageAllocator<char>>;

  void append(std::string_view text);

  ChunkedArray<Entry> entries_;
  std::deque<Block> blocks_;  // the texts, one after the other; none is split
  std::vector<Block> spare_;  // to be filled again: new memory costs more than what it is for
  std::size_t block_size_ = std::size_t{1} << 16;  // of the next new block
};

}  // namespace pipeline
