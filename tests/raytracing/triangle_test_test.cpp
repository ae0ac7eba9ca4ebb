#include "libpipeline/raytracing/triangle_test.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <utility>

#include "libpipeline/numbers/int128.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {
namespace {

using Wide = Int128;

/// A window of 2 x 2 at the distance 1, in pixels whose centers are odd multiples of 2^-6.
constexpr int kPixels = 64;

ProjectionTransform right_angle() {
  ProjectionTransform projection;
  projection.x_scale = projection.y_scale = Ball(1);
  projection.near = 1;
  projection.far = 1024;
  return projection;
}

ProjectionTransform parallel() {
  ProjectionTransform projection = right_angle();
  projection.is_perspective = false;
  return projection;
}

struct WholePoint {
  std::int64_t x, y, z;
};

Vec3 to_vec3(const WholePoint& p) {
  return {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
}

/// 64^2 times the area that the edge makes with the ray through a pixel's center, exactly.
Wide area(const WholePoint& from, const WholePoint& to, std::int64_t column, std::int64_t row,
          bool is_perspective) {
  const auto moved_x = [&](const WholePoint& p) {
    return Wide{64} * p.x - (2 * column + 1 - kPixels) * (is_perspective ? Wide{-p.z} : Wide{1});
  };
  const auto moved_y = [&](const WholePoint& p) {
    return Wide{64} * p.y - (kPixels - 2 * row - 1) * (is_perspective ? Wide{-p.z} : Wide{1});
  };
  return moved_x(from) * moved_y(to) - moved_y(from) * moved_x(to);
}

int sign(Wide value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// Both projections, and triangles of very different sizes.
class Random : public ::testing::TestWithParam<bool> {};

TEST_P(Random, HitsAndMissesAreTrueAndAnEdgeIsNeverEither) {
  const bool is_perspective = GetParam();
  const ProjectionTransform projection = is_perspective ? right_angle() : parallel();
  const PixelRays rays(projection, {kPixels, kPixels});
  const TriangleTest test(rays, NdcDepth(projection));
  std::mt19937_64 rng(1);
  std::array<int, 3> counts = {};
  for (int i = 0; i < 200'000; ++i) {
    const std::int64_t reach = std::int64_t{1} << (rng() % 20);
    const auto whole = [&](std::int64_t low, std::int64_t high) {
      return low + static_cast<std::int64_t>(rng() % static_cast<std::uint64_t>(high - low + 1));
    };
    std::array<WholePoint, 3> p;
    for (WholePoint& corner : p) corner = {whole(-reach, reach), whole(-reach, reach), whole(-reach, -1)};
    const auto column = static_cast<int>(rng() % kPixels), row = static_cast<int>(rng() % kPixels);
    std::array<int, 3> signs;
    for (std::size_t e = 0; e < 3; ++e)
      signs[e] = sign(area(p[e], p[(e + 1) % 3], column, row, is_perspective));
    const bool is_on_edge = signs[0] == 0 || signs[1] == 0 || signs[2] == 0;
    const bool is_inside = signs[0] == signs[1] && signs[1] == signs[2];
    const Hit hit = test(rays.ray(row, column), {to_vec3(p[0]), to_vec3(p[1]), to_vec3(p[2])});
    ++counts[static_cast<std::size_t>(hit.result)];
    if (hit.result == HitResult::uncertain) {
      ASSERT_TRUE(is_on_edge) << "these numbers are far from any error bound";
    } else if (hit.result == HitResult::hit) {
      ASSERT_TRUE(is_inside && !is_on_edge);
    } else {
      ASSERT_FALSE(is_inside && !is_on_edge);
    }
  }
  for (const int count : counts) EXPECT_GT(count, 50);
}

INSTANTIATE_TEST_SUITE_P(TriangleTest, Random, ::testing::Bool());

TEST(TriangleTest, NeighborsLeaveNoCrack) {
  const ProjectionTransform projection = right_angle();
  const PixelRays rays(projection, {kPixels, kPixels});
  const TriangleTest test(rays, NdcDepth(projection));
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> distance(0.5, 9);
  const auto random_pixel = [&] { return static_cast<int>(rng() % kPixels); };
  for (int i = 0; i < 20'000; ++i) {
    // A fan around a point on one ray, whose edges lead to points on others, and beyond the window.
    const auto point_on_ray = [&](const Ray& ray, double reach) {
      const double w = distance(rng);
      return Vec3{ray.direction.x * reach * w, ray.direction.y * reach * w, -w};
    };
    const int row = random_pixel(), column = random_pixel();
    const Vec3 middle = point_on_ray(rays.ray(row, column), 1);
    std::array<Vec3, 4> outline;
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const double x = corner == 0 || corner == 3 ? -3 : 3, y = corner < 2 ? -3 : 3;
      outline[corner] = point_on_ray({{}, {x, y, -1}}, 1);
    }
    for (const auto& [r, c] : {std::pair(row, column), std::pair(random_pixel(), random_pixel())}) {
      bool is_missed = true;
      for (std::size_t corner = 0; corner < 4; ++corner)
        is_missed &= test(rays.ray(r, c), {middle, outline[corner], outline[(corner + 1) % 4]}).result ==
                     HitResult::miss;
      ASSERT_FALSE(is_missed);
    }
  }
}

TEST(TriangleTest, DepthLiesInItsInterval) {
  const ProjectionTransform projection = right_angle();
  const PixelRays rays(projection, {kPixels, kPixels});
  const TriangleTest test(rays, NdcDepth(projection));
  // The plane z = -d faces the eye: its depth is (1025 - 2048 / d) / 1023.
  for (const double d : {1.0, 2.0, 31.0, 1000.0}) {
    const Hit hit =
        test(rays.ray(20, 40), {Vec3{-3 * d, -3 * d, -d}, Vec3{3 * d, -3 * d, -d}, Vec3{0, 3 * d, -d}});
    ASSERT_EQ(hit.result, HitResult::hit);
    const long double depth = (1025 - 2048 / static_cast<long double>(d)) / 1023;
    EXPECT_LE(hit.depth.low, depth);
    EXPECT_GE(hit.depth.high, depth);
    EXPECT_LT(hit.depth.high - hit.depth.low, 1e-10);
  }
}

TEST(TriangleTest, HugeAndTinyTrianglesAreDoubtfulRatherThanWrong) {
  const ProjectionTransform projection = right_angle();
  const PixelRays rays(projection, {kPixels, kPixels});
  const TriangleTest test(rays, NdcDepth(projection));
  for (const double size : {1e-200, 1e200, 1e308}) {
    const Hit hit =
        test(rays.ray(32, 32), {Vec3{-size, -size, -size}, Vec3{size, -size, -size}, Vec3{0, size, -size}});
    EXPECT_NE(hit.result, HitResult::miss) << size;
  }
}

TEST(TriangleTest, ATriangleWithoutAreaIsNoHit) {
  const ProjectionTransform projection = right_angle();
  const PixelRays rays(projection, {kPixels, kPixels});
  const TriangleTest test(rays, NdcDepth(projection));
  const Vec3 a = {-1, -1, -2}, b = {1, 1, -2};
  EXPECT_NE(test(rays.ray(32, 32), {a, b, b}).result, HitResult::hit);
  EXPECT_NE(test(rays.ray(32, 32), {a, a, a}).result, HitResult::hit);
}

}  // namespace
}  // namespace pipeline
