#include "libpipeline/picture/shading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pipeline {
namespace {

// Two in front of the eye, facing it.
const SurfacePoint kFacing = {{0, 0, -2}, {0, 0, 1}, {255, 128, 10}};

Lighting lit_by(const Vec3& position, const Vec3& intensity) {
  Lighting lighting;
  lighting.lights = {{position, intensity}};
  return lighting;
}

void expect_near(const Vec3& color, const Vec3& expected) {
  EXPECT_NEAR(color.x, expected.x, 1e-12);
  EXPECT_NEAR(color.y, expected.y, 1e-12);
  EXPECT_NEAR(color.z, expected.z, 1e-12);
}

TEST(Shading, WithoutLightEverythingIsBlack) {
  EXPECT_EQ(lit_color(kFacing, {}), (Vec3{}));
}

TEST(Shading, WhiteAmbientLightShowsTheColorAsItIs) {
  Lighting lighting;
  lighting.ambient = {1, 1, 1};
  EXPECT_EQ(lit_color(kFacing, lighting), kFacing.color);
}

TEST(Shading, ALightBehindTheEyeShowsAFacingSurfaceFully) {
  EXPECT_EQ(lit_color(kFacing, lit_by({0, 0, 1}, {1, 1, 1})), kFacing.color);
}

TEST(Shading, DiffuseLightFallsWithTheCosine) {
  // n = (0 0 1), l = (0 3 4) / 5: n.l = 0.8.
  expect_near(lit_color(kFacing, lit_by({0, 3, 2}, {1, 0.5, 0})), {204, 51.2, 0});
}

TEST(Shading, ALightBehindTheSurfaceDoesNotReachIt) {
  EXPECT_EQ(lit_color(kFacing, lit_by({0, 0, -5}, {1, 1, 1})), (Vec3{}));
}

TEST(Shading, ANormalTurnedAwayCountsAsTurnedTowardsTheEye) {
  SurfacePoint point = kFacing;
  point.normal = {0, 0, -7};
  EXPECT_EQ(lit_color(point, lit_by({0, 0, 1}, {1, 1, 1})), kFacing.color);
}

TEST(Shading, ANormalAtARightAngleToTheEyeIsNotTurned) {
  SurfacePoint point = kFacing;
  point.normal = {0, 1, 0};
  EXPECT_EQ(lit_color(point, lit_by({0, 3, -2}, {1, 1, 1})), kFacing.color);
  EXPECT_EQ(lit_color(point, lit_by({0, -3, -2}, {1, 1, 1})), (Vec3{}));
}

TEST(Shading, DistanceAttenuatesByTheWholeQuadratic) {
  // d = 3: 1 / (1 + 2 * 3 + 3 * 9) = 1 / 34.
  Lighting lighting = lit_by({0, 0, 1}, {1, 1, 1});
  lighting.attenuation = {1, 2, 3};
  expect_near(lit_color(kFacing, lighting), {255.0 / 34, 128.0 / 34, 10.0 / 34});
}

TEST(Shading, LightFromADistanceBeyondADoubleIsWeakenedOnlyAsAsked) {
  // The two parts of the distance are doubles, the distance itself is not: it overflows to infinity.
  Lighting lighting = lit_by({0, 1.5e308, 1.5e308}, {1, 1, 1});
  const double cosine = std::sqrt(0.5);
  expect_near(lit_color(kFacing, lighting), {255 * cosine, 128 * cosine, 10 * cosine});
  lighting.attenuation = {1, 1e-300, 0};
  EXPECT_EQ(lit_color(kFacing, lighting), (Vec3{}));
  lighting.attenuation = {1, 0, 1e-300};
  EXPECT_EQ(lit_color(kFacing, lighting), (Vec3{}));
}

TEST(Shading, TheHighlightTakesTheHalfVectorToThePowerAndTheLightsColor) {
  // l = (4 0 3) / 5 and v = (0 0 1): h = (4 0 8) / sqrt 80, n.h = 2 / sqrt 5, to the power 4 it is 16 / 25.
  Lighting lighting = lit_by({4, 0, 1}, {1, 0.5, 0});
  const Material material = {1, 0, 0.5, 4};
  expect_near(lit_color(kFacing, lighting, material), {255 * 0.5 * 0.64, 255 * 0.25 * 0.64, 0});
}

TEST(Shading, ALightBehindTheSurfaceGivesNoHighlight) {
  // l = (4 0 -3) / 5 and v = (0 0 1): h = (4 0 2) / sqrt 20, n.h = 1 / sqrt 5, but n.l = -0.6.
  Lighting lighting = lit_by({4, 0, -5}, {1, 1, 1});
  Material material = {1, 1, 1, 2};
  EXPECT_EQ(lit_color(kFacing, lighting, material), (Vec3{}));
  // Opposite the eye h is 0, and 0 to the power 0 is 1.
  lighting.lights = {{{0, 0, -5}, {1, 1, 1}}};
  material.shininess = 0;
  EXPECT_EQ(lit_color(kFacing, lighting, material), (Vec3{}));
}

TEST(Shading, ALightInTheSurfacesPlaneGivesNoHighlight) {
  // n.l = 0; h = (1 0 1) / sqrt 2, n.h squared is 1 / 2.
  Lighting lighting = lit_by({1, 0, -2}, {1, 1, 1});
  const Material material = {1, 1, 1, 2};
  EXPECT_EQ(lit_color(kFacing, lighting, material), (Vec3{}));
  // Just above the plane, the whole highlight is there: n.l = 2^-20, n.h squared is about (1 + 2^-20) / 2.
  lighting.lights = {{{1, 0, -2 + 0x1p-20}, {1, 1, 1}}};
  EXPECT_NEAR(lit_color(kFacing, lighting, material).y, 127.5 + (127.5 + 128) * 0x1p-20, 1e-9);
}

TEST(Shading, OneLightBehindTheSurfaceTakesNothingFromTheOthers) {
  Lighting lighting = lit_by({4, 0, -5}, {1, 1, 1});
  lighting.lights.push_back({{4, 0, 1}, {1, 0.5, 0}});
  const Material material = {1, 0, 0.5, 4};
  expect_near(lit_color(kFacing, lighting, material), {255 * 0.5 * 0.64, 255 * 0.25 * 0.64, 0});
}

TEST(Shading, TheEyeOfAnOrthographicViewIsFarAway) {
  // The light stands above the point, so h = (0 0 1); seen from an eye at the origin it would not be.
  const SurfacePoint point = {{3, 0, -4}, {0, 0, 1}, {0, 0, 0}};
  Lighting lighting = lit_by({3, 0, 0}, {1, 1, 1});
  const Material material = {1, 1, 1, 2};
  lighting.is_perspective = false;
  EXPECT_EQ(lit_color(point, lighting, material), (Vec3{255, 255, 255}));
  // v = (-3 0 4) / 5, l = (0 0 1): h = (-3 0 9) / sqrt 90, n.h squared is 81 / 90.
  lighting.is_perspective = true;
  expect_near(lit_color(point, lighting, material), {229.5, 229.5, 229.5});
}

TEST(Shading, LightsAddUp) {
  Lighting lighting = lit_by({0, 0, 1}, {0.25, 0, 0});
  lighting.lights.push_back({{0, 0, 5}, {0.5, 1, 0}});
  EXPECT_EQ(lit_color(kFacing, lighting), (Vec3{191.25, 128, 0}));
}

TEST(Shading, ALightInThePointItselfShinesOnNothing) {
  Lighting lighting = lit_by({0, 0, -2}, {1, 1, 1});
  lighting.attenuation = {0, 0, 1};
  EXPECT_EQ(lit_color(kFacing, lighting), (Vec3{}));
}

TEST(Shading, ANormalOfNoDirectionFacesNothing) {
  SurfacePoint point = kFacing;
  point.normal = {};
  EXPECT_EQ(lit_color(point, lit_by({0, 0, 1}, {1, 1, 1})), (Vec3{}));
}

TEST(Shading, PowersAreWhole) {
  EXPECT_EQ(whole_power(0, 0), 1);
  EXPECT_EQ(whole_power(0.5, 1), 0.5);
  EXPECT_EQ(whole_power(3, 5), 243);
  EXPECT_EQ(whole_power(0.5, 1000), 0x1p-1000);
  EXPECT_EQ(whole_power(0.5, std::numeric_limits<std::size_t>::max()), 0);
}

TEST(Shading, ClampedChannelsStayBetween0And255) {
  EXPECT_EQ(clamped_color({-3, 255.5, 1e300}), (Vec3{0, 255, 255}));
  EXPECT_EQ(clamped_color({0.25, 254.75, 255}), (Vec3{0.25, 254.75, 255}));
}

TEST(Shading, ChannelsRoundHalvesUpAndStopAtTheEnds) {
  EXPECT_EQ(rounded_color({0.5, 0.49, 127.5}), Color(1, 0, 128));
  EXPECT_EQ(rounded_color({-3, 255.6, 1e300}), Color(0, 255, 255));
  EXPECT_EQ(rounded_color({254.5, 254.49, 255}), Color(255, 254, 255));
}

TEST(Shading, WhatDoublesMissOfAHalfCounts) {
  EXPECT_EQ(rounded_color({3.5 - 0x1p-21, 3.5 - 0x1p-19, 0.5 - 1e-13}), Color(4, 3, 1));
}

}  // namespace
}  // namespace pipeline
