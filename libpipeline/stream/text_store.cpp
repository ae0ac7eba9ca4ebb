#include "libpipeline/stream/text_store.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pipeline {
namespace {

// From here on, blocks are on large pages.
constexpr std::size_t kMaxBlockSize = 2 * kLargePage;

}  // namespace

void TextStore::add(const TriangleBatch& batch) {
  append(batch.texts.lines());
  for (std::size_t i = 0; i < batch.size(); ++i)
    entries_.push_back({batch.numbers[i], static_cast<std::uint32_t>(batch.texts.length(i)), false});
}

void TextStore::append(std::string_view text) {
  const auto has_room = [&](const Block& block) { return block.capacity() - block.size() >= text.size(); };
  if (blocks_.empty() || !has_room(blocks_.back())) {
    if (!spare_.empty() && has_room(spare_.back())) {
      blocks_.push_back(std::move(spare_.back()));
      spare_.pop_back();
    } else {
      blocks_.emplace_back().reserve(std::max(block_size_, text.size()));
      block_size_ = std::min(2 * block_size_, kMaxBlockSize);
    }
  }
  blocks_.back().insert(blocks_.back().end(), text.begin(), text.end());
}

void TextStore::complete(KeptIds& kept) const {
  const auto count = static_cast<KeptIds::Id>(size());
  for (KeptIds::Id begin = 0, end = 0; begin < count; begin = end) {
    for (end = begin + 1; end < count && number(end) == number(begin);) ++end;
    if (end == begin + 1 && !entries_[begin].is_needed) continue;
    bool is_any_kept = false;
    for (KeptIds::Id id = begin; id < end; ++id) is_any_kept |= kept.is_kept(id) || entries_[id].is_needed;
    for (KeptIds::Id id = begin; is_any_kept && id < end; ++id) kept.keep(id);
  }
}

KeptIds::Id TextStore::begin_of_last() const {
  auto begin = static_cast<KeptIds::Id>(size() - 1);
  while (begin > 0 && number(begin - 1) == number(begin)) --begin;
  return begin;
}

/// The texts move towards the front; blocks that are read are filled again.
void TextStore::keep(const KeptIds& kept) {
  std::deque<Block> old;
  old.swap(blocks_);
  std::size_t begin = 0;  // of the next text, in the first block
  for (KeptIds::Id id = 0; id < size(); ++id) {
    if (begin == old.front().size()) {
      old.front().clear();
      spare_.push_back(std::move(old.front()));
      old.pop_front();
      begin = 0;
    }
    const std::size_t length = entries_[id].length;
    if (kept.is_kept(id)) append({&old.front()[begin], length});
    begin += length;
  }
  entries_.keep(kept);
}

void TextStore::write(TextWriter& text, const KeptIds& kept) const {
  std::uint64_t next_number = 0;
  auto block = blocks_.begin();
  std::size_t begin = 0;
  for (KeptIds::Id id = 0; id < size(); ++id) {
    if (begin == block->size()) {
      ++block;
      begin = 0;
    }
    const auto& [number, length, is_needed] = entries_[id];
    if (kept.is_kept(id)) {
      if (number != next_number) text.append("triangle " + std::to_string(number) + "\n");
      text.append({&(*block)[begin], length});
      next_number = number + 1;
    }
    begin += length;
  }
}

}  // namespace pipeline
