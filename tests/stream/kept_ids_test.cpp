#include "libpipeline/stream/kept_ids.h"

#include <gtest/gtest.h>

#include <vector>

namespace pipeline {
namespace {

/// Of `count` ids those that `chosen` names.
KeptIds kept_of(std::size_t count, const std::vector<KeptIds::Id>& chosen) {
  KeptIds kept(count);
  for (const KeptIds::Id id : chosen) kept.keep(id);
  return kept;
}

TEST(KeptIds, NewIdsAreInTheOldOrder) {
  KeptIds kept = kept_of(6, {4, 1, 5, 1});
  EXPECT_EQ(kept.renumber(), 3u);
  EXPECT_EQ(kept.new_id(1), 0u);
  EXPECT_EQ(kept.new_id(4), 1u);
  EXPECT_EQ(kept.new_id(5), 2u);
  EXPECT_FALSE(kept.is_kept(0));
  EXPECT_FALSE(kept.is_kept(3));
}

TEST(KeptIds, APixelWithoutATriangleStaysOne) {
  KeptIds kept = kept_of(2, {KeptIds::kNoTriangle});
  EXPECT_EQ(kept.renumber(), 0u);
  EXPECT_EQ(kept.new_id(KeptIds::kNoTriangle), KeptIds::kNoTriangle);
}

/// The numbers from `first` on.
ChunkedArray<int> counted_from(int first, int count) {
  ChunkedArray<int> array;
  for (int i = 0; i < count; ++i) array.push_back(first + i);
  return array;
}

// Chunks hold 1024 entries: some stay full, one becomes shorter, others empty.
TEST(ChunkedArray, KeepsEntriesInOrderAndGrowsOn) {
  ChunkedArray<int> array = counted_from(100, 5000);
  KeptIds kept(array.size());
  for (KeptIds::Id id = 0; id < 5000; id += 3) kept.keep(id);
  array.keep(kept);
  ASSERT_EQ(array.size(), 1667u);
  for (int i = 0; i < 5000; ++i) array.push_back(-i);
  ASSERT_EQ(array.size(), 6667u);
  for (std::size_t i = 0; i < 1667; ++i) ASSERT_EQ(array[i], 100 + 3 * static_cast<int>(i));
  for (std::size_t i = 0; i < 5000; ++i) ASSERT_EQ(array[1667 + i], -static_cast<int>(i));
  EXPECT_EQ(array.back(), -4999);
}

TEST(ChunkedArray, MayKeepNothingOrAll) {
  ChunkedArray<int> array = counted_from(0, 2048);
  KeptIds all(2048);
  for (KeptIds::Id id = 0; id < 2048; ++id) all.keep(id);
  array.keep(all);
  EXPECT_EQ(array.size(), 2048u);
  EXPECT_EQ(array.back(), 2047);
  array.keep(KeptIds(2048));
  EXPECT_EQ(array.size(), 0u);
  array.push_back(7);
  EXPECT_EQ(array[0], 7);
}

}  // namespace
}  // namespace pipeline
