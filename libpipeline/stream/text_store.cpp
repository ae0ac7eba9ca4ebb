#include "libpipeline/stream/text_store.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pipeline {
namespace {

// From here on, blocks are on large pages.
constexpr std::size_t kMaxBlockSize = 2 * kLargePage;

}  // namespace

std::uint64_t TextStore::number(KeptIds::Id id) const {
  std::size_t begin = 0, end = size();
  while (end - begin > 1) {
    const std::size_t middle = begin + (end - begin) / 2;
    (entries_[middle].id <= id ? begin : end) = middle;
  }
  return entries_[begin].number;
}

void TextStore::add(const Triangle& triangle, std::string_view text) {
  append(text);
  entries_.push_back({triangle.number, triangle.id, static_cast<std::uint32_t>(text.size()) & 0x7fffffff,
                      triangle.is_needed});
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

void TextStore::complete(KeptIds& kept, bool may_go_on) const {
  for (std::size_t begin = 0, end = 0; begin < size(); begin = end) {
    const Entry& first = entries_[begin];
    for (end = begin + 1; end < size() && entries_[end].number == first.number;) ++end;
    const bool is_one_piece = end == begin + 1;
    bool is_any_kept = may_go_on && end == size();
    if (is_one_piece && !first.is_needed && !is_any_kept) continue;
    for (std::size_t i = begin; i < end; ++i)
      is_any_kept |= entries_[i].is_needed || kept.is_kept(entries_[i].id);
    for (std::size_t i = begin; is_any_kept && i < end; ++i) kept.keep(entries_[i].id);
  }
}

/// The texts move towards the front; blocks that are read are filled again.
void TextStore::keep(const KeptIds& kept) {
  std::deque<Block> old;
  old.swap(blocks_);
  std::size_t begin = 0;  // of the next text, in the first block
  std::size_t count = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (begin == old.front().size()) {
      old.front().clear();
      spare_.push_back(std::move(old.front()));
      old.pop_front();
      begin = 0;
    }
    Entry entry = entries_[i];
    if (kept.is_kept(entry.id)) {
      append({&old.front()[begin], entry.length});
      entry.id = kept.new_id(entry.id);
      entries_[count++] = entry;
    }
    begin += entry.length;
  }
  entries_.truncate(count);
}

void TextStore::write(TextWriter& text, const KeptIds& kept) const {
  std::uint64_t next_number = 0;
  auto block = blocks_.begin();
  std::size_t begin = 0;
  for (std::size_t i = 0; i < size(); ++i) {
    if (begin == block->size()) {
      ++block;
      begin = 0;
    }
    const Entry& entry = entries_[i];
    if (kept.is_kept(entry.id)) {
      if (entry.number != next_number) text.append("triangle " + std::to_string(entry.number) + "\n");
      text.append({&(*block)[begin], entry.length});
      next_number = entry.number + 1;
    }
    begin += entry.length;
  }
}

}  // namespace pipeline
