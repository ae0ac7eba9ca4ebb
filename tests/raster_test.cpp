#include "libpipeline/raster.h"

#include <gtest/gtest.h>

namespace pipeline {
namespace {

TEST(Raster, IsFilledWithOneValue) {
  const Raster<int> raster(2, 3, 7);
  EXPECT_EQ(raster.rows(), 2);
  EXPECT_EQ(raster.columns(), 3);
  for (int row = 0; row < 2; ++row) {
    ASSERT_EQ(raster.row(row).size(), 3u);
    for (const int value : raster.row(row)) EXPECT_EQ(value, 7);
  }
}

TEST(Raster, RowsAreApart) {
  Raster<int> raster(3, 2, 0);
  raster.row(1)[0] = 1;
  raster.row(1)[1] = 2;
  EXPECT_EQ(raster.row(0)[1], 0);
  EXPECT_EQ(raster.row(1)[1], 2);
  EXPECT_EQ(raster.row(2)[0], 0);
}

TEST(Raster, RowsFollowEachOtherInMemory) {
  const Raster<char> raster(3, 5, 'x');
  EXPECT_EQ(raster.row(0).data() + 5, raster.row(1).data());
}

}  // namespace
}  // namespace pipeline
