#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace pipeline {

/// Which triangles of a store go on being kept. A store gives its triangles the ids 0, 1, 2 ...; those kept
/// get new ones, again from 0 and in the same order.
class KeptIds {
 public:
  using Id = std::uint32_t;
  /// The id of a pixel without a triangle, before and after.
  static constexpr Id kNoTriangle = std::numeric_limits<Id>::max();

  /// None of the ids 0 to `count` - 1 is kept.
  explicit KeptIds(std::size_t count) : new_ids_(count, kNoTriangle) {}

  /// The count of ids, kept or not.
  [[nodiscard]] std::size_t size() const { return new_ids_.size(); }
  void keep(Id id) {
    if (id != kNoTriangle) new_ids_[id] = 0;
  }
  [[nodiscard]] bool is_kept(Id id) const { return new_ids_[id] != kNoTriangle; }

  /// Gives those kept their new ids; returns how many they are.
  std::size_t renumber() {
    Id next = 0;
    for (Id& id : new_ids_)
      if (id != kNoTriangle) id = next++;
    return next;
  }
  /// The new id of one that is kept.
  [[nodiscard]] Id new_id(Id id) const {
    assert(id == kNoTriangle || is_kept(id));
    return id == kNoTriangle ? id : new_ids_[id];
  }

 private:
  std::vector<Id> new_ids_;
};

}  // namespace pipeline
