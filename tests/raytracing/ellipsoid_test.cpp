#include "libpipeline/raytracing/ellipsoid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

__extension__ typedef __float128 Quad;

Quad root_of(Quad x) {
  auto root = static_cast<Quad>(std::sqrt(static_cast<long double>(x)));
  for (int step = 0; step < 3; ++step) root = (root + x / root) / 2;
  return root;
}

SpherePoints sphere(const Vec3& center, double radius) {
  return {center, sum(center, {radius, 0, 0}), sum(center, {0, radius, 0}), sum(center, {0, 0, radius})};
}

/// The parameters where the line of a ray meets a sphere, in 113 bits; none if it misses.
std::optional<std::array<double, 2>> exact_meetings(const Ray& ray, const Vec3& center, double radius) {
  const auto quad = [](const Vec3& v) { return std::array<Quad, 3>{v.x, v.y, v.z}; };
  const auto o = quad(ray.origin), c = quad(center), d = quad(ray.direction);
  Quad ff = 0, fd = 0, dd = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Quad f = o[i] - c[i];
    ff += f * f;
    fd += f * d[i];
    dd += d[i] * d[i];
  }
  const Quad r = radius;
  const Quad discriminant = fd * fd - dd * (ff - r * r);
  if (discriminant < 0) return std::nullopt;
  const Quad root = root_of(discriminant);
  const Quad sum = fd > 0 ? -fd - root : -fd + root;
  const auto larger = static_cast<double>(sum / dd), smaller = static_cast<double>((ff - r * r) / sum);
  return std::array{std::min(larger, smaller), std::max(larger, smaller)};
}

double relative_error(double value, double exact) {
  return std::fabs(value - exact) / std::fabs(exact);
}

class EllipsoidOfRadius : public testing::TestWithParam<double> {};

/// A ground sphere below the eye: f.f - r^2 cancels nearly all of its digits.
TEST_P(EllipsoidOfRadius, FindsAGroundSphereWithinItsBound) {
  const double radius = GetParam();
  const Vec3 center = {0.25, -radius - 1.5, -3};
  const auto ground = Ellipsoid::from(sphere(center, radius));
  ASSERT_TRUE(ground);
  // The radius that the points say: their coordinates are rounded.
  const double radius_of_points = (center.y + radius) - center.y;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(-1, 1);
  int count = 0;
  for (int i = 0; i < 20000; ++i) {
    const Ray ray = {{}, {part(random), part(random) - 0.5, -1}};
    const auto expected = exact_meetings(ray, center, radius_of_points);
    const auto [entrance, exit] = ground->meetings(ray);
    if (std::isnan(entrance) || !expected) continue;  // whether it is hit is another test's matter
    ++count;
    // Past the edge by less than 1 % of the way, the root cancels.
    const auto [near, far] = *expected;
    if (std::fabs(far - near) < 0.01 * std::max(std::fabs(near), std::fabs(far))) continue;
    EXPECT_LE(relative_error(entrance, near), 0x1p-50);
    EXPECT_LE(relative_error(exit, far), 0x1p-50);
  }
  EXPECT_GT(count, 5000);
}

/// What is left of the start of a ray that leaves the surface: nothing, by its identity.
TEST_P(EllipsoidOfRadius, IsNotMetWhereARayStarts) {
  const double radius = GetParam();
  const Vec3 center = {0.25, -radius - 1.5, -3};
  const auto ground = Ellipsoid::from(sphere(center, radius));
  ASSERT_TRUE(ground);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> part(-1, 1);
  int inward_count = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray eye = {{}, {part(random), -1, part(random)}};
    const auto [near, far] = ground->meetings(eye);
    ASSERT_LT(near, far);
    const Vec3 start = sum(eye.origin, scaled(eye.direction, near));
    const Vec3 way = {part(random), part(random), part(random)};
    const double upward = dot(way, ground->normal(start));
    if (std::fabs(upward) < 1e-6) continue;
    const auto [entrance, exit] = ground->meetings({start, way}, true);
    ASSERT_TRUE(std::isnan(entrance));
    ASSERT_EQ(std::isnan(exit), upward > 0);
    if (upward > 0) continue;
    ++inward_count;
    // A chord is 2 r times the cosine.
    const double chord = 2 * radius * -upward / dot(way, way);
    EXPECT_LE(relative_error(exit, chord), 1e-6);
  }
  EXPECT_GT(inward_count, 500);
}

INSTANTIATE_TEST_SUITE_P(Radii, EllipsoidOfRadius, testing::Values(50.0, 1e4, 1e6, 1e8));

/// A chord of 4 on a ground sphere, between points of the parabola that it is here but for 1e-23: half of it
/// is 2e-8 radii, so what doubles leave of f.f - 1 is as large as the square of that.
TEST(Ellipsoid, LeavesAGrazedGroundSphereAtTheEndOfTheChord) {
  const double radius = 1e8;
  const auto ground = Ellipsoid::from(sphere({0, -radius, 0}, radius));
  ASSERT_TRUE(ground);
  const auto point = [&](double x) { return Vec3{x, -x * x / (2 * radius), 0}; };
  for (const double x : {1.154, 4.108, 3.0, -0.9}) {
    const Vec3 start = point(x);
    const auto [entrance, exit] = ground->meetings({start, difference(point(x - 4), start)}, true);
    EXPECT_TRUE(std::isnan(entrance));
    EXPECT_NEAR(exit, 1, 1e-7);
  }
}

TEST(Ellipsoid, HasNoneOfPointsInAPlane) {
  EXPECT_FALSE(Ellipsoid::from({Vec3{1, 2, 3}, {2, 2, 3}, {1, 3, 3}, {5, 7, 3}}));
  EXPECT_FALSE(Ellipsoid::from({Vec3{1, 2, 3}, {1, 2, 3}, {1, 3, 3}, {5, 7, 4}}));
  EXPECT_TRUE(Ellipsoid::from({Vec3{1, 2, 3}, {2, 2, 3}, {1, 3, 3}, {5, 7, 3.0000001}}));
  EXPECT_TRUE(Ellipsoid::from(sphere({}, 1e-100)));
  EXPECT_TRUE(Ellipsoid::from(sphere({}, 1e100)));
}

/// Every point that rays find lies on the surface u^2 + v^2 + w^2 = 1, and in the box; the normal is that of
/// the gradient.
TEST(Ellipsoid, IsTheImageOfASphere) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> part(-1, 1);
  const auto any = [&] { return Vec3{part(random), part(random), part(random)}; };
  int hit_count = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 c = any(), a = any(), b = any(), d = any();
    const double volume = dot(a, cross(b, d));
    if (std::fabs(volume) < 0.05) continue;
    const auto ellipsoid = Ellipsoid::from({c, sum(c, a), sum(c, b), sum(c, d)});
    ASSERT_TRUE(ellipsoid);
    const Vec3 origin = scaled(any(), 5);
    const Ray ray = {origin, difference(sum(c, scaled(any(), 0.5)), origin)};
    const auto [entrance, exit] = ellipsoid->meetings(ray);
    for (const auto& [t, is_front] : {std::pair(entrance, true), std::pair(exit, false)}) {
      if (std::isnan(t)) continue;
      ++hit_count;
      const Vec3 p = sum(ray.origin, scaled(ray.direction, t));
      const Vec3 from_center = difference(p, c);
      // By Cramer's rule.
      const double u = dot(from_center, cross(b, d)) / volume, v = dot(from_center, cross(d, a)) / volume,
                   w = dot(from_center, cross(a, b)) / volume;
      EXPECT_NEAR(u * u + v * v + w * w, 1, 1e-10);
      const Vec3 gradient = sum(sum(scaled(cross(b, d), u), scaled(cross(d, a), v)), scaled(cross(a, b), w));
      const Vec3 normal = unit_vector(scaled(gradient, volume < 0 ? -1 : 1));
      EXPECT_NEAR(dot(ellipsoid->normal(p), normal), 1, 1e-12);
      EXPECT_EQ(dot(ray.direction, normal) < 0, is_front);
      const BoundingBox box = ellipsoid->box();
      EXPECT_LE(box.low.x - 1e-12, p.x);
      EXPECT_GE(box.high.x + 1e-12, p.x);
      EXPECT_LE(box.low.y - 1e-12, p.y);
      EXPECT_GE(box.high.y + 1e-12, p.y);
      EXPECT_LE(box.low.z - 1e-12, p.z);
      EXPECT_GE(box.high.z + 1e-12, p.z);
    }
  }
  EXPECT_GT(hit_count, 1000);
}

/// A ray is missed or met as the exact discriminant says, unless it grazes the sphere by less than 2^-40.
TEST(Ellipsoid, IsMissedOnlyByRaysThatMissIt) {
  const auto unit = Ellipsoid::from(sphere({}, 1));
  ASSERT_TRUE(unit);
  for (const double gap : {-0x1p-40, 0x1p-40, -1e-3, 1e-3}) {
    for (int degrees = 0; degrees < 360; degrees += 7) {
      const double angle = degrees * 0.017453292519943295, distance = 1 + gap;
      const Ray ray = {{distance * std::cos(angle), distance * std::sin(angle), 9}, {0, 0, -1}};
      const auto [entrance, exit] = unit->meetings(ray);
      EXPECT_EQ(entrance < exit, gap < 0);
    }
  }
}

}  // namespace
}  // namespace pipeline
