#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace pipeline {

/// The choice of the triangles that a store keeps. A store gives its triangles the ids 0, 1, 2 ...; the kept
/// triangles get new ids, again from 0 and in the same order.
class KeptIds {
 public:
  using Id = std::uint32_t;
  /// The id of a pixel without a triangle, before and after renumbering.
  static constexpr Id kNoTriangle = std::numeric_limits<Id>::max();

  /// Begins with the ids 0 to `count` - 1, none of them kept.
  explicit KeptIds(std::size_t count) : new_ids_(count, kNoTriangle) {}

  /// The count of ids, kept or not.
  [[nodiscard]] std::size_t size() const { return new_ids_.size(); }
  void keep(Id id) {
    if (id != kNoTriangle) new_ids_[id] = 0;
  }
  [[nodiscard]] bool is_kept(Id id) const { return new_ids_[id] != kNoTriangle; }

  /// Gives the kept triangles their new ids; returns their count.
  std::size_t renumber() {
    Id next = 0;
    for (Id& id : new_ids_)
      if (id != kNoTriangle) id = next++;
    return next;
  }
  /// The new id of a kept triangle.
  [[nodiscard]] Id new_id(Id id) const {
    assert(id == kNoTriangle || is_kept(id));
    return id == kNoTriangle ? id : new_ids_[id];
  }

 private:
  std::vector<Id> new_ids_;
};

/// An array with one entry per triangle of a store. It grows without being copied, and takes no more memory
/// than its entries and one chunk.
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
  /// Keeps the entries of the kept triangles; the memory of the others is reused.
  void keep(const KeptIds& kept) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      if (!kept.is_kept(static_cast<KeptIds::Id>(i))) continue;
      if (count != i) (*this)[count] = std::move((*this)[i]);  // moved to itself, a string would be empty
      ++count;
    }
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
