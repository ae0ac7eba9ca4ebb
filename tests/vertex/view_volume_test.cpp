#include "libpipeline/vertex/view_volume.h"

#include <gtest/gtest.h>

#include "tests/vertex/projected.h"

namespace pipeline {
namespace {

// kSimple: 90 degrees wide and high, from distance 1 to distance 100.
std::optional<OutsidePart> place_of(const Triangle& p_view, double clip_inset = 0) {
  return ViewVolume(kSimple, clip_inset).outside(p_view);
}

TEST(ViewVolume, ATriangleInViewHasNoPartToName) {
  EXPECT_EQ(place_of(triangle_at(-2, -2, -2)), std::nullopt);
  EXPECT_EQ(place_of({Vec3{-9, -9, -2}, Vec3{9, -9, -2}, Vec3{0, 99, -2}}), std::nullopt);  // covers it all
}

TEST(ViewVolume, NamesThePlane) {
  EXPECT_EQ(place_of(triangle_at(0, 1, 2)), OutsidePart::behind);
  EXPECT_EQ(place_of(triangle_at(-0.5, 1, 2)), OutsidePart::near);
  EXPECT_EQ(place_of(triangle_at(-101, -102, -103)), OutsidePart::far);
  EXPECT_EQ(place_of({Vec3{-3, 0, -2}, Vec3{-4, 0, -2}, Vec3{-3, 1, -2}}), OutsidePart::left);
  EXPECT_EQ(place_of({Vec3{3, 0, -2}, Vec3{4, 0, -2}, Vec3{3, 1, -2}}), OutsidePart::right);
  EXPECT_EQ(place_of({Vec3{0, -3, -2}, Vec3{1, -3, -2}, Vec3{0, -4, -2}}), OutsidePart::below);
  EXPECT_EQ(place_of({Vec3{0, 3, -2}, Vec3{1, 3, -2}, Vec3{0, 4, -2}}), OutsidePart::above);
}

TEST(ViewVolume, OfTwoPlanesTheFirstCounts) {
  EXPECT_EQ(place_of({Vec3{3, 3, -2}, Vec3{4, 3, -2}, Vec3{3, 4, -2}}), OutsidePart::right);
  EXPECT_EQ(place_of({Vec3{300, 0, -101}, Vec3{400, 0, -101}, Vec3{300, 1, -101}}), OutsidePart::far);
}

TEST(ViewVolume, PastAnEdgeThePlaneThatTakesTheLastOfItCounts) {
  // Crosses the planes right and top, but not the volume.
  EXPECT_EQ(place_of({Vec3{0, 5, -2}, Vec3{5, 0, -2}, Vec3{5, 5, -2}}), OutsidePart::above);
  EXPECT_EQ(place_of({Vec3{0, 3, -2}, Vec3{3, 0, -2}, Vec3{3, 3, -2}}), std::nullopt);
}

TEST(ViewVolume, TheBorderIsInside) {
  EXPECT_EQ(place_of({Vec3{2, 0, -2}, Vec3{2, 1, -2}, Vec3{2, 0, -3}}), std::nullopt);
}

TEST(ViewVolume, AnInsetPullsInThePlanes) {
  const Triangle at_the_right = {Vec3{1.9, 0, -2}, Vec3{1.95, 0, -2}, Vec3{1.9, 0.1, -2}};
  EXPECT_EQ(place_of(at_the_right), std::nullopt);
  EXPECT_EQ(place_of(at_the_right, 0.1), OutsidePart::right);
}

TEST(ViewVolume, AParallelProjectionHasNoBehind) {
  const ProjectionTransform parallel = {false, 1, 0, 1, 0, -1, 100};
  EXPECT_EQ(ViewVolume(parallel).outside(triangle_at(0.5, 0.5, 0.5)), std::nullopt);
  EXPECT_EQ(ViewVolume(parallel).outside(triangle_at(2, 2, 2)), OutsidePart::near);
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

}  // namespace
}  // namespace pipeline
