#include "libpipeline/picture/shading.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "libpipeline/numbers/vec_math.h"
#include "tests/numbers/testable_targets.h"

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

TEST(Shading, ANormalAtARightAngleToTheEyeIsNotTurned) {
  SurfacePoint point = kFacing;
  point.normal = {0, 1, 0};
  EXPECT_EQ(lit_color(point, lit_by({0, 3, -2}, {1, 1, 1})), kFacing.color);
  EXPECT_EQ(lit_color(point, lit_by({0, -3, -2}, {1, 1, 1})), (Vec3{}));
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
  // n.h = 2 / sqrt 5, as above.
  Material material = {1, 0, 1, 0};
  for (const auto& [exponent, power] : {std::pair(0u, 1.0),
                                        {1u, 2 / std::sqrt(5)},
                                        {5u, 32 / std::sqrt(3125)},
                                        {10u, 1024.0 / 3125},
                                        {10000u, std::pow(0.8, 5000)}}) {
    material.shininess = exponent;
    EXPECT_NEAR(lit_color(kFacing, lit_by({4, 0, 1}, {1, 1, 1}), material).x, 255 * power, 1e-12);
  }
  material.shininess = std::numeric_limits<std::uint64_t>::max();
  EXPECT_EQ(lit_color(kFacing, lit_by({4, 0, 1}, {1, 1, 1}), material), (Vec3{}));
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

constexpr int kRow = 2, kColumns = 21;

/// A lit triangle, or a sliver of one, whose weights doubles cannot tell.
struct RandomRun {
  explicit RandomRun(std::mt19937_64& rng) {
    const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(rng); };
    const auto vec = [&] { return Vec3{number(), number(), number()}; };
    ClipTriangle triangle;
    for (std::size_t v = 0; v < 3; ++v) {
      triangle[v] = {scaled(vec(), 3), 2 + number(), {}, {}};
      corners[v] = {sum(vec(), {0, 0, -3}), vec(), sum(scaled(vec(), 127), {128, 128, 128})};
    }
    if (rng() % 4 == 0) triangle[2].position = sum(triangle[1].position, scaled(vec(), 1e-14));
    weights = CornerWeights(grid, triangle, rng() % 2 == 0);
    material = {0.5, 1, static_cast<int>(rng() % 3) * 0.5, rng() % 200};
    for (std::size_t i = rng() % 3; i > 0; --i)
      lighting.lights.push_back({scaled(vec(), 5), {0.5, 0.7, 0.9}});
    lighting.ambient = {0.1, 0.2, 0.3};
    if (rng() % 2 == 0) lighting.attenuation = {0.5, 0.1, 0.1};
    lighting.is_perspective = rng() % 2 == 0;
  }

  [[nodiscard]] Color color(int column, bool is_lit) const {
    const auto weight = weights.exactly_at(grid, kRow, column);
    const auto& [a, b, c] = corners;
    const SurfacePoint point = {mean(Triangle{a.position, b.position, c.position}, weight),
                                mean(Triangle{a.normal, b.normal, c.normal}, weight),
                                mean(Triangle{a.color, b.color, c.color}, weight)};
    return rounded_color(is_lit ? lit_color(point, lighting, material) : point.color);
  }

  PixelGrid grid{Viewport{kColumns, 5}};
  CornerWeights weights;
  std::array<SurfacePoint, 3> corners;
  Material material;
  Lighting lighting;
};

TEST(Shading, EveryKernelColorsARunAsItsPixelsOneByOne) {
  for (const std::size_t target : testable_targets(kRunShaders)) {
    SCOPED_TRACE(kTargets[target]);
    std::mt19937_64 rng(1);
    for (int i = 0; i < 400; ++i) {
      const RandomRun run(rng);
      const bool is_lit = i % 2 == 0;
      const int first = i % 5, count = 1 + i % (kColumns - first);
      const Color untouched(1, 2, 3);
      std::vector<Color> colors(kColumns + kMaxLanesShaded, untouched);
      kRunShaders[target](
          {run.weights, run.corners, is_lit ? &run.material : nullptr, run.grid, kRow, first, count},
          run.lighting, &colors[0]);
      const auto end = static_cast<std::size_t>(count);
      for (std::size_t k = 0; k < end; ++k)
        EXPECT_EQ(colors[k], run.color(first + static_cast<int>(k), is_lit)) << i << " at " << k;
      for (std::size_t k = end + kMaxLanesShaded - 1; k < colors.size(); ++k) EXPECT_EQ(colors[k], untouched);
    }
  }
}

}  // namespace
}  // namespace pipeline
