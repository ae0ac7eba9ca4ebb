#include "libpipeline/raytracing/refraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pipeline {
namespace {

// From Snell's law in long doubles; s by sines and p by tangents (A. Fresnel, 1823).
long double expected_reflectance(long double ratio, long double angle) {
  const long double other = std::asin(ratio * std::sin(angle));
  const long double s = std::sin(angle - other) / std::sin(angle + other);
  const long double p = std::tan(angle - other) / std::tan(angle + other);
  return (s * s + p * p) / 2;
}

TEST(Fresnel, IsThatOfSinesAndTangents) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> indices(0.4, 2.5), angles(0.01, 1.5);
  int refracted_count = 0;
  for (int i = 0; i < 100'000; ++i) {
    const double ratio = indices(rng), angle = angles(rng);
    const double found = fresnel_reflectance(ratio, std::cos(angle));
    ASSERT_GE(found, 0);
    ASSERT_LE(found, 1);
    const double sine = ratio * std::sin(angle);
    if (sine > 1) {
      ASSERT_EQ(found, 1);
    } else if (sine < 0.999 && std::fabs(ratio - 1) > 0.01) {
      ASSERT_NEAR(found, static_cast<double>(expected_reflectance(ratio, angle)), 1e-11)
          << ratio << ' ' << angle;
      ++refracted_count;
    }
  }
  EXPECT_GT(refracted_count, 50'000);
}

TEST(Fresnel, IsNothingWithinOneMedium) {
  for (const double cosine : {0.0, 1e-9, 0.5, 1.0}) EXPECT_EQ(fresnel_reflectance(1, cosine), 0);
}

TEST(Refraction, OfIndex1IsTheRayItself) {
  const Vec3 direction = {0.6, 0, -0.8};
  EXPECT_EQ(refracted(direction, {0, 0, 1}, 1), direction);
}

TEST(Refraction, FollowsSnellInThePlaneOfRayAndNormal) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> ratios(0.4, 2.5), numbers(-1, 1);
  for (int i = 0; i < 20'000; ++i) {
    const Vec3 normal = unit_vector({numbers(rng), numbers(rng), numbers(rng)});
    Vec3 ray = unit_vector({numbers(rng), numbers(rng), numbers(rng)});
    if (dot(ray, normal) > 0) ray = scaled(ray, -1);
    const double ratio = ratios(rng);
    const auto bent = refracted(ray, normal, ratio);
    const Vec3 across = cross(ray, normal);
    const double sine = std::sqrt(dot(across, across));
    ASSERT_EQ(bent.has_value(), ratio == 1 || ratio * sine < 1 || std::fabs(ratio * sine - 1) < 1e-12);
    if (!bent) continue;
    // n1 (ray x normal) = n2 (bent x normal): the law and the plane at once.
    const Vec3 found = cross(*bent, normal);
    ASSERT_NEAR(found.x, ratio * across.x, 1e-9);
    ASSERT_NEAR(found.y, ratio * across.y, 1e-9);
    ASSERT_NEAR(found.z, ratio * across.z, 1e-9);
    ASSERT_LE(dot(*bent, normal), 0);
    const Vec3 mirror = mirrored(ray, normal);
    ASSERT_NEAR(dot(mirror, normal), -dot(ray, normal), 1e-12);
    ASSERT_NEAR(dot(cross(mirror, normal), across), dot(across, across), 1e-12);
  }
}

}  // namespace
}  // namespace pipeline
