#include "libpipeline/vertex/matrix_stack.h"

#include <gtest/gtest.h>

#include "libpipeline/vertex/transform.h"

namespace pipeline {
namespace {

/// The image of the origin under the stack's matrix.
Vec3 image_of_origin(const MatrixStack& stack) {
  const auto& rows = stack.top().rows;
  return {rows[0][3].nearest_double(), rows[1][3].nearest_double(), rows[2][3].nearest_double()};
}

TEST(MatrixStack, ARepeatedPushIsKeptApartFromALaterOne) {
  MatrixStack stack;
  EXPECT_TRUE(stack.push());
  EXPECT_TRUE(stack.push());
  stack.translate({1, 0, 0});
  EXPECT_TRUE(stack.push());
  stack.translate({1, 0, 0});
  for (double x : {1.0, 0.0, 0.0}) {
    EXPECT_TRUE(stack.pop());
    EXPECT_EQ(image_of_origin(stack), (Vec3{x, 0, 0}));
  }
  EXPECT_FALSE(stack.pop());
}

TEST(MatrixStack, PoppedMatricesMayBeChanged) {
  MatrixStack stack;
  EXPECT_TRUE(stack.push());
  EXPECT_TRUE(stack.push());
  EXPECT_TRUE(stack.pop());
  stack.translate({1, 0, 0});
  EXPECT_TRUE(stack.pop());
  EXPECT_EQ(image_of_origin(stack), (Vec3{0, 0, 0}));
}

TEST(MatrixStack, HoldsALimitedNumberOfDifferentMatrices) {
  MatrixStack stack(3);
  for (int i = 0; i < 3; ++i) {
    stack.translate({1, 0, 0});
    EXPECT_TRUE(stack.push());
  }
  stack.translate({1, 0, 0});
  EXPECT_FALSE(stack.push());
  EXPECT_EQ(image_of_origin(stack), (Vec3{4, 0, 0}));
}

TEST(MatrixStack, PopMakesRoomInAFullStack) {
  MatrixStack stack(1);
  EXPECT_TRUE(stack.push());
  stack.translate({1, 0, 0});
  EXPECT_FALSE(stack.push());
  EXPECT_TRUE(stack.pop());
  EXPECT_TRUE(stack.push());
}

TEST(MatrixStack, AMatrixEqualToTheOneSavedLastDoesNotCountEither) {
  MatrixStack stack(1);
  stack.translate({1, 0, 0});
  EXPECT_TRUE(stack.push());
  stack.translate({2, 0, 0});
  stack.translate({-2, 0, 0});
  EXPECT_TRUE(stack.push());
  for (int i = 0; i < 2; ++i) {
    stack.translate({5, 0, 0});
    EXPECT_TRUE(stack.pop());
    EXPECT_EQ(image_of_origin(stack), (Vec3{1, 0, 0}));
  }
  EXPECT_FALSE(stack.pop());
}

TEST(MatrixStack, TheLimitIsTwoToTheTwentieth) {
  EXPECT_EQ(MatrixStack().max_saved(), 1048576u);
}

TEST(MatrixStack, TenMillionPushesAreCounted) {
  MatrixStack stack;
  for (int i = 0; i < 10'000'000; ++i) ASSERT_TRUE(stack.push());
  for (int i = 0; i < 10'000'000; ++i) ASSERT_TRUE(stack.pop());
  EXPECT_FALSE(stack.pop());
}

}  // namespace
}  // namespace pipeline
