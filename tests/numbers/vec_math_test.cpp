#include "libpipeline/numbers/vec_math.h"

#include <gtest/gtest.h>

namespace pipeline {
namespace {

// Different primes, so that no two products are equal.
constexpr Vec3 kA = {2, 3, 5};
constexpr Vec3 kB = {7, 11, 13};

TEST(VecMath, AddsSubtractsAndScalesByCoordinates) {
  EXPECT_EQ(sum(kA, kB), (Vec3{9, 14, 18}));
  EXPECT_EQ(difference(kA, kB), (Vec3{-5, -8, -8}));
  EXPECT_EQ(scaled(kA, -2), (Vec3{-4, -6, -10}));
}

TEST(VecMath, MultipliesByTheDefinitions) {
  EXPECT_EQ(dot(kA, kB), 2 * 7 + 3 * 11 + 5 * 13);
  EXPECT_EQ(cross(kA, kB), (Vec3{3 * 13 - 5 * 11, 5 * 7 - 2 * 13, 2 * 11 - 3 * 7}));
}

TEST(VecMath, AUnitVectorKeepsItsDirectionAtAnySize) {
  for (const double size : {1.0, 0x1p-1060, 1e-200, 1e300}) {
    const Vec3 unit = unit_vector({2 * size, -3 * size, 6 * size});
    EXPECT_NEAR(unit.x, 2.0 / 7, 1e-15) << size;
    EXPECT_NEAR(unit.y, -3.0 / 7, 1e-15) << size;
    EXPECT_NEAR(unit.z, 6.0 / 7, 1e-15) << size;
  }
  EXPECT_EQ(unit_vector({}), (Vec3{}));
}

TEST(VecMath, TheMeanWeighsEveryCorner) {
  const Triangle corners = {Vec3{8, 0, 16}, Vec3{0, 8, 32}, Vec3{16, 24, 0}};
  EXPECT_EQ(mean(corners, {0.5, 0.25, 0.25}), (Vec3{8, 8, 16}));
}

}  // namespace
}  // namespace pipeline
