#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string_view>
#include <vector>

#include "libpipeline/stream/chunked_array.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/memory.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// The texts of triangles, each under an id; later ones have greater ids.
class TextStore {
 public:
  struct Triangle {
    std::uint64_t number;  // in the scene
    KeptIds::Id id;
    bool is_needed;  // for good
  };

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  /// The number of a triangle of the store.
  [[nodiscard]] std::uint64_t number(KeptIds::Id id) const;

  void add(const Triangle& triangle, std::string_view text);
  /// Adds to those kept the needed ones, and the other pieces of each triangle: a wireframe asks a piece's
  /// neighbors which of its edges are cuts. Pieces follow one another with one number. With `may_go_on`, more
  /// pieces of the last triangle may follow, so it is kept.
  void complete(KeptIds& kept, bool may_go_on) const;
  /// Drops all texts but the kept ones, which get new ids.
  void keep(const KeptIds& kept);
  /// Writes the kept texts as the body of a stage text.
  void write(TextWriter& text, const KeptIds& kept) const;

 private:
  using Block = std::vector<char, LargePageAllocator<char>>;
  struct Entry {
    std::uint64_t number;
    KeptIds::Id id;
    std::uint32_t length : 31;  // of the text
    std::uint32_t is_needed : 1;
  };
  static_assert(sizeof(Entry) == 16);

  void append(std::string_view text);

  ChunkedArray<Entry> entries_;
  std::deque<Block> blocks_;  // the texts, one after the other; none is split
  std::vector<Block> spare_;  // to be filled again: new memory costs more than the text in it
  std::size_t block_size_ = std::size_t{1} << 16;  // of the next new block
};

}  // namespace pipeline
