#include "libpipeline/raytracing/surface_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// A bumpy sheet of triangles around the origin, counterclockwise from +z.
std::vector<Triangle> sheet(std::mt19937_64& rng, double bump) {
  constexpr int kSize = 8;
  std::uniform_real_distribution<double> shift(-0.3, 0.3), height(-bump, bump);
  std::vector<std::vector<Vec3>> points;
  for (int i = -kSize; i <= kSize; ++i) {
    points.emplace_back();
    for (int k = -kSize; k <= kSize; ++k)
      points.back().push_back({i + shift(rng), k + shift(rng), height(rng)});
  }
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      triangles.push_back({points[i][k], points[i + 1][k], points[i + 1][k + 1]});
      triangles.push_back({points[i][k], points[i + 1][k + 1], points[i][k + 1]});
    }
  return triangles;
}

TEST(SurfaceTriangle, NoRayPassesBetweenNeighbors) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> from(-3, 3), part(0, 1);
  const std::vector<Triangle> triangles = sheet(rng, 0.2);
  std::uniform_int_distribution<std::size_t> any(0, triangles.size() - 1), corner(0, 2);
  for (int i = 0; i < 20'000; ++i) {
    const Triangle& aimed_at = triangles[any(rng)];
    const std::size_t first = corner(rng);
    const double t = i % 3 == 0 ? 0 : part(rng);  // a corner, or a point of an edge
    const Vec3 target = sum(scaled(aimed_at[first], 1 - t), scaled(aimed_at[(first + 1) % 3], t));
    if (std::fabs(target.x) > 6 || std::fabs(target.y) > 6) continue;
    const Vec3 origin = {from(rng), from(rng), i % 2 == 0 ? 5.0 : -5.0};
    const SurfaceTriangleTest test(SurfaceRay{{origin, difference(target, origin)}});
    const auto is_met = [&](const Triangle& triangle) { return test(triangle).has_value(); };
    ASSERT_TRUE(std::ranges::any_of(triangles, is_met)) << i;
  }
}

TEST(SurfaceTriangle, MeansAreWithinTheirErrorOfThePlane) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> coordinate(-1, 1), weight(0, 1);
  for (int i = 0; i < 100'000; ++i) {
    const double size = std::exp2(20 * coordinate(rng));
    Triangle p;
    for (Vec3& v : p)
      v = {size * (coordinate(rng) + 3), size * coordinate(rng), size * (coordinate(rng) - 7)};
    const Vec3 origin = {0.1 * size * coordinate(rng), 0.1 * size * coordinate(rng), 2 * size};
    const Vec3 target = mean(p, {0.2, 0.3, 0.5});
    const auto meeting = SurfaceTriangleTest(SurfaceRay{{origin, difference(target, origin)}}).known(p);
    const Vec3 found = mean(p, meeting.weights);
    const long double sum =
        static_cast<long double>(meeting.weights[0]) + meeting.weights[1] + meeting.weights[2];
    const auto exact = [&](auto axis) {
      long double value = 0;
      for (std::size_t v = 0; v < 3; ++v)
        value += static_cast<long double>(meeting.weights[v]) / sum * axis(p[v]);
      return value;
    };
    const double error = error_of_mean(p);
    ASSERT_LE(std::fabs(exact([](const Vec3& v) { return v.x; }) - found.x), error);
    ASSERT_LE(std::fabs(exact([](const Vec3& v) { return v.y; }) - found.y), error);
    ASSERT_LE(std::fabs(exact([](const Vec3& v) { return v.z; }) - found.z), error);
    ASSERT_LT(error, 1e-13 * 11 * size);  // and it is small
  }
}

/// A ray that starts on a triangle of a plane far from the origin meets no other of it, whatever its way, but
/// a wall a little beyond.
TEST(SurfaceTriangle, AStartOnAPlaneDoesNotMeetIt) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> coordinate(-1, 1), weight(0.1, 1);
  for (int i = 0; i < 50'000; ++i) {
    const Vec3 corner = {1000 * coordinate(rng), 1000 * coordinate(rng), 1000 * coordinate(rng)};
    const Vec3 a = {coordinate(rng), coordinate(rng), coordinate(rng)};
    const Vec3 b = {coordinate(rng), coordinate(rng), coordinate(rng)};
    const Triangle own = {corner, sum(corner, a), sum(corner, b)};
    const Triangle neighbor = {sum(corner, a), sum(sum(corner, a), b), sum(corner, b)};
    const Vec3 area = cross(a, b);
    if (dot(area, area) < 0.01) continue;
    const double u = weight(rng), v = weight(rng), w = weight(rng), all = u + v + w;
    const Vec3 start = mean(own, {u / all, v / all, w / all});
    // Nearly along the plane, toward the neighbor, from the side that roundings have put the start on or not.
    const Vec3 along = difference(mean(neighbor, {0.3, 0.4, 0.3}), start);
    const Vec3 direction = sum(along, scaled(unit_vector(area), 1e-13 * coordinate(rng)));
    const SurfaceTriangleTest test(SurfaceRay{{start, direction}, 0, error_of_mean(own)});
    ASSERT_FALSE(test(neighbor)) << i;
    const Vec3 up = scaled(unit_vector(area), 1e-6);
    Triangle wall = {sum(start, up), sum(start, up), sum(start, up)};
    wall[0] = sum(wall[0], scaled(a, 3));
    wall[1] = sum(wall[1], scaled(b, 3));
    wall[2] = difference(wall[2], scaled(sum(a, b), 3));
    const auto met = SurfaceTriangleTest(SurfaceRay{{start, unit_vector(area)}, 0, error_of_mean(own)})(wall);
    ASSERT_TRUE(met) << i;
    ASSERT_NEAR(met->t, 1e-6, 1e-9);
  }
}

}  // namespace
}  // namespace pipeline
