#include "libpipeline/visibility/raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <new>
#include <stdexcept>

namespace pipeline {
namespace {

TEST(Raster, IsFilledWithOneValue) {
  const Raster<int> raster({0, 2}, 3, 7);
  EXPECT_EQ(raster.row_range().end, 2);
  EXPECT_EQ(raster.columns(), 3);
  for (int row = 0; row < 2; ++row) {
    ASSERT_EQ(raster.row(row).size(), 3u);
    for (const int value : raster.row(row)) EXPECT_EQ(value, 7);
  }
}

TEST(Raster, OneWithoutValuesTakesThem) {
  Raster<int> raster({0, 2}, 3);
  for (int row = 0; row < 2; ++row) std::ranges::fill(raster.row(row), 7 + row);
  EXPECT_EQ(std::ranges::count(raster.row(0), 7), 3);
  EXPECT_EQ(std::ranges::count(raster.row(1), 8), 3);
}

TEST(Raster, RowsAreApart) {
  Raster<int> raster({0, 3}, 2, 0);
  raster.row(1)[0] = 1;
  raster.row(1)[1] = 2;
  EXPECT_EQ(raster.row(0)[1], 0);
  EXPECT_EQ(raster.row(1)[1], 2);
  EXPECT_EQ(raster.row(2)[0], 0);
}

TEST(Raster, RowsFollowEachOtherInMemory) {
  const Raster<char> raster({0, 3}, 5, 'x');
  EXPECT_EQ(raster.row(0).data() + 5, raster.row(1).data());
}

TEST(Raster, ALargeOneBeginsWithALargePageAndIsFilled) {
  const Raster<int> raster({0, 1025}, 1024, 7);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(raster.row(0).data()) % (1 << 21), 0u);
  for (int row = 0; row < 1025; ++row)
    ASSERT_EQ(std::count(raster.row(row).begin(), raster.row(row).end(), 7), 1024) << row;
}

TEST(Raster, OneThatNoMemoryHoldsIsAnError) {
  struct Kilobyte {
    std::array<char, 1024> bytes;
  };
  const auto make = [] { return Raster<Kilobyte>({0, 2147483647}, 2147483647, {}); };
  EXPECT_THROW(make(), std::length_error);
}

TEST(Raster, ItsMemoryIsCountedInBytesWithoutOverflow) {
  LargePageAllocator<int> allocator;
  EXPECT_THROW((void)allocator.allocate(SIZE_MAX / sizeof(int) + 2), std::bad_array_new_length);
}

}  // namespace
}  // namespace pipeline
