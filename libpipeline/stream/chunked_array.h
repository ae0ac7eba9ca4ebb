#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "libpipeline/stream/kept_ids.h"

namespace pipeline {

/// An array, with one entry per triangle of a store, that grows without being copied: it never takes more
/// memory than for its entries and one chunk.
template <typename T>
class ChunkedArray {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] T& operator[](std::size_t index) { return chunks_[index / kChunk][index % kChunk]; }
  [[nodiscard]] const T& operator[](std::size_t index) const {
    return chunks_[index / kChunk][index % kChunk];
  }
  [[nodiscard]] T& back() { return (*this)[size_ - 1]; }

  void push_back(const T& entry) {
    if (size_ == chunks_.size() * kChunk) chunks_.emplace_back().reserve(kChunk);
    chunks_[size_ / kChunk].push_back(entry);
    ++size_;
  }
  /// Keeps the entries of the triangles that are kept. The memory of the others is used for the next ones.
  void keep(const KeptIds& kept) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (!kept.is_kept(static_cast<KeptIds::Id>(i))) continue;
      if (count != i) (*this)[count] = std::move((*this)[i]);  // to itself, a string would be empty
      ++count;
    }
    truncate(count);
  }

  /// Keeps the first `count` entries.
  void truncate(std::size_t count) {
    for (std::size_t i = count / kChunk; i < chunks_.size(); ++i) {
      const std::size_t left = std::min(chunks_[i].size(), count - std::min(count, i * kChunk));
      chunks_[i].erase(chunks_[i].begin() + static_cast<std::ptrdiff_t>(left), chunks_[i].end());
    }
    size_ = count;
  }

 private:
  static constexpr std::size_t kChunk = 1024;

  std::vector<std::vector<T>> chunks_;
  std::size_t size_ = 0;
};

}  // namespace pipeline
