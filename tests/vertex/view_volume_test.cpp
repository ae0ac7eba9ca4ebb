#include "libpipeline/vertex/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/vertex/projected.h"

namespace pipeline {
namespace {

// kSimple: 90 degrees wide and high, from distance 1 to distance 100.
std::optional<UnseenPlace> place_of(const Triangle& p_view, double clip_inset = 0) {
  return ViewVolume(kSimple, clip_inset).outside(p_view);
}

TEST(ViewVolume, AnInsetPullsInThePlanes) {
  const Triangle at_the_right = {Vec3{1.9, 0, -2}, Vec3{1.95, 0, -2}, Vec3{1.9, 0.1, -2}};
  EXPECT_EQ(place_of(at_the_right), std::nullopt);
  EXPECT_EQ(place_of(at_the_right, 0.1), UnseenPlace::right);
}

TEST(ViewVolume, DropsWhatTheStageDrops) {
  RandomNumbers random(3);
  std::size_t dropped_count = 0;
  for (int i = 0; i < 2000; ++i) {
    Triangle triangle;
    for (Vec3& p : triangle) p = {random.between(-4, 4), random.between(-4, 4), random.between(-3, 1)};
    const bool is_dropped = projected(batch_of({triangle}), kSimple, ClipMode::frustum).p_ndc.empty();
    EXPECT_EQ(place_of(triangle).has_value(), is_dropped) << "triangle " << i;
    dropped_count += is_dropped ? 1 : 0;
  }
  EXPECT_GT(dropped_count, 500u);
  EXPECT_LT(dropped_count, 1900u);
}

struct VolumeCase {
  ProjectionTransform projection;
  double clip_inset;

  [[nodiscard]] CertainSides quick(const Triangle& p_view) const {
    return certain_sides(coefficients_of(projection, clip_inset), p_view);
  }
  [[nodiscard]] unsigned exact(const Vec3& p_view) const {
    return outcode(to_clip_space(projection, p_view, clip_inset));
  }
};

VolumeCase random_volume(RandomNumbers& random) {
  const double near = std::exp2(random.between(-30, 30));
  const double far = near * (1 + std::exp2(random.between(-20, 40)));
  const double inset = random.bits() % 2 == 0 ? 0 : random.between(0, 1);
  const auto side = [&] { return near * random.with_exponent(-8, 8); };
  const double left = side(), bottom = side();
  const double right = left + std::fabs(side()), top = bottom + std::fabs(side());
  const Projection frustum = Frustum{left, right, bottom, top, near, far};
  const Projection ortho = Orthographic{left, right, bottom, top, near, far};
  return {transform_of(random.bits() % 4 == 0   ? ortho
                       : random.bits() % 2 == 0 ? Projection(random_perspective(random))
                                                : frustum),
          inset};
}

/// A point anywhere, before or behind the eye, or beside a plane, by 2^-52 of its distance to 2^-10.
Vec3 random_point_near(const ProjectionTransform& projection, RandomNumbers& random) {
  const auto beside = [&] {
    const double sign = random.bits() % 2 == 0 ? 1 : -1;
    return sign * (1 + random.whole(-1, 1) * std::exp2(random.whole(-52, -10)));
  };
  const double near = projection.near, far = projection.far;
  const double distance = random.bits() % 4 == 0   ? near * beside()
                          : random.bits() % 3 == 0 ? far * beside()
                                                   : random.between(-far / 4, 5 * far / 4);
  const double w = projection.is_perspective ? distance : 1, q = projection.is_perspective ? -distance : 1;
  const auto coordinate = [&](const Ball& scale, const Ball& offset) {
    const double ndc = random.bits() % 2 == 0 ? beside() : random.between(-3, 3);
    return (ndc * w - offset.nearest_double() * q) / scale.nearest_double();
  };
  return {coordinate(projection.x_scale, projection.x_offset),
          coordinate(projection.y_scale, projection.y_offset), -distance};
}

TEST(CertainSides, ContradictsNoOutcodeOfBalls) {
  RandomNumbers random(41);
  int decided_count = 0, outside_count = 0;
  for (int i = 0; i < 30000; ++i) {
    const VolumeCase c = random_volume(random);
    Triangle p_view;
    for (Vec3& p : p_view) p = random_point_near(c.projection, random);
    if (i % 3 == 0) p_view[1] = p_view[2] = p_view[0];
    std::uint64_t all = SideBlock::kAllPlanes, any = 0;
    for (const Vec3& p : p_view) all &= c.exact(p), any |= c.exact(p);
    const CertainSides sides = c.quick(p_view);
    ASSERT_EQ(sides.all_outside & ~all, 0u) << i;
    ASSERT_EQ(all & ~sides.none_inside, 0u) << i;
    ASSERT_EQ(any & ~sides.some_unsure, 0u) << i;
    ASSERT_EQ((sides.all_outside | sides.none_inside | sides.some_unsure) & ~SideBlock::kAllPlanes, 0u) << i;
    decided_count += (all != 0) == (sides.all_outside != 0) ? 1 : 0;
    outside_count += all != 0 ? 1 : 0;
  }
  EXPECT_GT(outside_count, 10000);
  EXPECT_GT(decided_count, 25000);
}

TEST(CertainSides, DecidesBesideAPlaneFrom2ToMinus28OfTheDistance) {
  const VolumeCase c = {kSimple, 0};
  for (const double sign : {-1.0, 1.0}) {
    const auto at = [&](double part) { return triangle_at(-part, -part, -part); };
    const auto beside = [&](int exponent) { return at(1 + sign * std::exp2(exponent)); };
    EXPECT_EQ((c.quick(beside(-27)).all_outside & 1u) != 0, sign < 0);
    EXPECT_EQ((c.quick(beside(-27)).some_unsure & 1u) != 0, sign < 0);
    EXPECT_EQ(c.quick(beside(-40)).all_outside & 1u, 0u);
    EXPECT_EQ(c.quick(beside(-40)).none_inside & 1u, 1u);
  }
}

TEST(CertainSides, IsCertainOfNothingWhereDoublesAreNot) {
  const ProjectionTransform beyond = {true, std::exp2(600), 0, std::exp2(-600), 0, 1, 100};
  constexpr double kLargest = std::numeric_limits<double>::max();
  const Triangle there = triangle_at(-2, -2, -2);
  const CertainSides sides = VolumeCase{beyond, 0}.quick(there);
  constexpr std::uint64_t kXAndY = 0b111100;
  EXPECT_EQ(sides.all_outside & kXAndY, 0u);
  EXPECT_EQ(sides.none_inside & kXAndY, kXAndY);
  EXPECT_EQ(sides.some_unsure & kXAndY, kXAndY);
  for (const double size : {kLargest, 5e-324, 0.0}) {
    const Vec3 p = {size, -size, -size};
    const CertainSides extreme = VolumeCase{{true, 3, 1, 3, -1, 1e-300, 1e300}, 0}.quick({p, p, p});
    EXPECT_EQ(extreme.all_outside & kXAndY, 0u) << size;
    EXPECT_EQ(extreme.some_unsure & kXAndY, kXAndY) << size;
  }
}

TEST(ClipModeReject, DropsWhatHasAllCornersOutsideOfOnePlaneByTheirOutcodes) {
  RandomNumbers random(42);
  std::uint64_t dropped_count = 0;
  for (int i = 0; i < 5000; ++i) {
    const VolumeCase c = random_volume(random);
    Triangle p_view;
    for (Vec3& p : p_view) p = random_point_near(c.projection, random);
    std::uint64_t all = SideBlock::kAllPlanes;
    for (const Vec3& p : p_view) all &= c.exact(p);
    const bool is_behind = std::ranges::any_of(p_view, [](const Vec3& p) { return p.z >= 0; });
    if (all == 0 && is_behind && c.projection.is_perspective) continue;  // an error
    const Result result = projected(batch_of({p_view}), c.projection, ClipMode::reject, CullMode::nothing,
                                    {2}, Precision::in_doubles, c.clip_inset);
    ASSERT_EQ(result.counts.outside, all != 0 ? 1u : 0u) << i;
    dropped_count += result.counts.outside;
  }
  EXPECT_GT(dropped_count, 1000u);
}

}  // namespace
}  // namespace pipeline
