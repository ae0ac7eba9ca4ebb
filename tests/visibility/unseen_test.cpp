#include "libpipeline/visibility/unseen.h"

#include <gtest/gtest.h>

#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/visibility/depth_format.h"
#include "tests/numbers/random_numbers.h"
#include "tests/visibility/visible_frames.h"

namespace pipeline {
namespace {

constexpr Viewport kFourByFour = {4, 4, -1, -1, 0, 2};  // a pixel is 0.5 wide; centers are at 0.25 and 0.75

/// A right triangle whose right angle is at (x, y).
Triangle corner_at(double x, double y, double z, double size = 1) {
  return {Vec3{x, y, z}, Vec3{x + size, y, z}, Vec3{x, y + size, z}};
}

TriangleBatch batch_of(const std::vector<Triangle>& triangles) {
  TriangleBatch batch;
  for (const Triangle& t : triangles) batch.add(t, batch.size(), {1, 2, 3});
  return batch;
}

template <typename Coverage = NearestCoverage, typename Depth = DepthF64>
EmptyPicture watched(const std::vector<Triangle>& triangles) {
  EmptyPicture picture({TypeValue<Coverage>(), TypeValue<Depth>(), 0}, kFourByFour);
  picture.add(batch_of(triangles));
  return picture;
}

UnseenPlace reason_of(const Triangle& triangle) {
  const auto picture = watched(std::vector{triangle});
  EXPECT_TRUE(picture.is_empty());
  for (std::size_t i = 0; i < picture.triangles().groups.size(); ++i)
    if (picture.triangles().groups[i].count == 1) return static_cast<UnseenPlace>(i);
  ADD_FAILURE() << "no reason";
  return UnseenPlace::near;
}

TEST(EmptyPicture, ATriangleHasOneReason) {
  EXPECT_EQ(reason_of(corner_at(0, 0, -0.5)), UnseenPlace::near);
  EXPECT_EQ(reason_of(corner_at(0, 0, 2)), UnseenPlace::far);
  EXPECT_EQ(reason_of(corner_at(-2.5, 0, 1)), UnseenPlace::left);
  EXPECT_EQ(reason_of(corner_at(1.5, 0, 1)), UnseenPlace::right);
  EXPECT_EQ(reason_of(corner_at(0, -2.5, 1)), UnseenPlace::below);
  EXPECT_EQ(reason_of(corner_at(0, 1.5, 1)), UnseenPlace::above);
  EXPECT_EQ(reason_of({Vec3{0, 0, 1}, Vec3{0.5, 0, 1}, Vec3{1, 0, 1}}), UnseenPlace::without_area);
  EXPECT_EQ(reason_of(corner_at(0.3, 0.3, 1, 0.1)), UnseenPlace::between_centers);
}

TEST(EmptyPicture, ATrianglePastACornerIsOutside) {
  EXPECT_EQ(reason_of({Vec3{0.5, 3, 1}, Vec3{3, 0.5, 1}, Vec3{3, 3, 1}}), UnseenPlace::above);
  EXPECT_EQ(reason_of({Vec3{0.5, 5, 1}, Vec3{5, 5, 1}, Vec3{2, 0.5, 1}}), UnseenPlace::right);
  EXPECT_EQ(reason_of({Vec3{-0.5, -5, 1}, Vec3{-2, -0.5, 1}, Vec3{-5, -5, 1}}), UnseenPlace::left);
  EXPECT_EQ(reason_of({Vec3{-5, -0.5, 1}, Vec3{-0.5, -2, 1}, Vec3{-5, -5, 1}}), UnseenPlace::below);
}

TEST(EmptyPicture, OfSeveralReasonsTheFirstCounts) {
  EXPECT_EQ(reason_of(corner_at(3, 3, 5)), UnseenPlace::far);
  EXPECT_EQ(reason_of(corner_at(3, 3, 1, 0)), UnseenPlace::right);
}

TEST(EmptyPicture, ATriangleThroughALimitMayHaveFragmentsOnOneSideAlone) {
  // Its only fragment is near the corner before the front limit.
  EXPECT_EQ(reason_of({Vec3{0.25, 0.25, -1}, Vec3{0.4, 0.25, 3}, Vec3{0.25, 0.4, 3}}), UnseenPlace::near);
  EXPECT_EQ(reason_of({Vec3{0.25, 0.25, 3}, Vec3{0.4, 0.25, -1}, Vec3{0.25, 0.4, -1}}), UnseenPlace::far);
}

TEST(EmptyPicture, BetweenTwoPixelsATriangleMayCrossAllVisibleDepths) {
  // On a row, depths go from -10 to 10 between two centers.
  EXPECT_EQ(reason_of({Vec3{-0.1, 0, -10}, Vec3{0.4, 0, 10}, Vec3{-0.1, 1, -10}}), UnseenPlace::near);
}

TEST(EmptyPicture, ASpanIsSearchedBetweenItsEnds) {
  // From z = -6 on the left of the screen to z = 8 on the right: only the pixels in the middle are visible.
  for (const double sign : {-1, 1}) {
    const Triangle slope = {Vec3{-2 * sign, -9, -12}, Vec3{2 * sign, -9, 16}, Vec3{0, 9, 2}};
    EXPECT_FALSE(watched(std::vector{slope}).is_empty());
  }
}

TEST(EmptyPicture, MeasuresUpToTheFirstTriangleThatShows) {
  const auto picture =
      watched({corner_at(1.5, 0, 1), corner_at(3, 1, 1), corner_at(0, 0, 1), corner_at(9, 0, 1)});
  EXPECT_FALSE(picture.is_empty());
  for (const auto& group : picture.triangles().groups)
    EXPECT_EQ(group.count, &group == &picture.triangles()[UnseenPlace::right] ? 2u : 0u);
  const auto& right = picture.triangles()[UnseenPlace::right];
  EXPECT_EQ(right.count, 2u);
  EXPECT_EQ(right.extent.low, (Vec3{1.5, 0, 1}));
  EXPECT_EQ(right.extent.high, (Vec3{4, 2, 1}));
}

TEST(EmptyPicture, WithoutTrianglesThePictureIsEmpty) {
  const auto picture = watched({});
  EXPECT_TRUE(picture.is_empty());
  for (const auto& group : picture.triangles().groups) EXPECT_EQ(group.count, 0u);
}

/// Compares with the pictures of the z-buffer, on random triangles at the borders of what is visible.
template <typename Coverage, typename Depth>
void expect_what_is_drawn() {
  RandomNumbers random(1);
  std::size_t empty_count = 0;
  const auto one_of = [&](std::initializer_list<double> choices) {
    return choices.begin()[random.bits() % choices.size()];
  };
  for (int i = 0; i < 3000; ++i) {
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {one_of({-1.25, -1, -0.8, 0.2, 0.25, 0.3, 1, 1.25, 3}),
           one_of({-3, -1, -0.25, 0.25, 0.26, 0.9, 1, 1.25}), one_of({-0.5, 0, 1, 2 - 0x1p-40, 2, 2.5})};
    const Frame frame = zbuffer_frame<Coverage, Depth>({triangle}, kFourByFour, 0);
    const bool is_empty = frame == zbuffer_frame<Coverage, Depth>({}, kFourByFour, 0);
    EXPECT_EQ((watched<Coverage, Depth>({triangle}).is_empty()), is_empty) << "triangle " << i;
    empty_count += is_empty ? 1 : 0;
  }
  EXPECT_GT(empty_count, 500u);
  EXPECT_LT(empty_count, 2500u);
}

TEST(EmptyPicture, IsEmptyExactlyIfTheZBufferDrawsNothing) {
  expect_what_is_drawn<NearestCoverage, DepthF64>();
  expect_what_is_drawn<NearestCoverage, DepthF32>();
  expect_what_is_drawn<CenterCoverage, DepthF64>();
  expect_what_is_drawn<CenterCoverage, DepthU24>();
}

}  // namespace
}  // namespace pipeline
