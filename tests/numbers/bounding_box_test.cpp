#include "libpipeline/numbers/vec_math.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pipeline {
namespace {

TEST(BoundingBox, IsThatOfAllCornersInAnyOrder) {
  // Every corner has the least of one coordinate and the largest of another.
  Triangle corners = {Vec3{-7, 5, 1}, Vec3{2, -4, 6}, Vec3{8, 3, -9}};
  for (int i = 0; i < 3; ++i) {
    const BoundingBox box(corners);
    EXPECT_EQ(box.low, (Vec3{-7, -4, -9}));
    EXPECT_EQ(box.high, (Vec3{8, 5, 6}));
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

TEST(BoundingBox, GrowsByWhatIsAdded) {
  BoundingBox box;
  box.add(Triangle{Vec3{1, 2, 3}, Vec3{1, 2, 3}, Vec3{1, 2, 3}});
  EXPECT_EQ(box.low, (Vec3{1, 2, 3}));
  EXPECT_EQ(box.high, (Vec3{1, 2, 3}));
  box.add(Triangle{Vec3{0, 5, 3}, Vec3{1, 2, -4}, Vec3{1, 2, 3}});
  EXPECT_EQ(box.low, (Vec3{0, 2, -4}));
  EXPECT_EQ(box.high, (Vec3{1, 5, 3}));
  box.add(BoundingBox());
  EXPECT_EQ(box.low, (Vec3{0, 2, -4}));
  EXPECT_EQ(box.high, (Vec3{1, 5, 3}));
}

}  // namespace
}  // namespace pipeline
