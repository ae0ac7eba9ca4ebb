#include "libpipeline/vertex/sphere_facets.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

using Point = std::tuple<double, double, double>;

Point rounded(const Vec3& p) {
  const auto digits = [](double x) { return std::nearbyint(x * 1e9) / 1e9 + 0; };
  return {digits(p.x), digits(p.y), digits(p.z)};
}

class SphereFacetsOf : public testing::TestWithParam<std::size_t> {};

/// Every edge belongs to two triangles, once in each direction, and Euler's formula holds.
TEST_P(SphereFacetsOf, AreAClosedSurface) {
  const SphereFacets facets(GetParam());
  const SphereCommand sphere = {{1, 2, 3}, 2, {}};
  std::map<std::array<Point, 2>, int> edges;
  std::map<Point, int> corners;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const auto facet = facets(sphere, i);
    for (std::size_t v = 0; v < 3; ++v) {
      ++edges[{rounded(facet.corners[v]), rounded(facet.corners[(v + 1) % 3])}];
      ++corners[rounded(facet.corners[v])];
    }
  }
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ((edges.count({edge[1], edge[0]})), 1u);
  }
  EXPECT_EQ(corners.size() + facets.size(), edges.size() / 2 + 2);
}

TEST_P(SphereFacetsOf, AreCounterclockwiseFromOutsideAndHaveAnArea) {
  const SphereFacets facets(GetParam());
  const SphereCommand sphere = {{-1, 0.5, 7}, 0.25, {}};
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const auto [p, normals] = facets(sphere, i);
    const Vec3 normal = cross(difference(p[1], p[0]), difference(p[2], p[0]));
    EXPECT_GT(dot(normal, normal), 0);
    EXPECT_GT(dot(normal, difference(p[0], sphere.center)), 0);
    for (std::size_t v = 0; v < 3; ++v) {
      EXPECT_NEAR(dot(normals[v], normals[v]), 1, 1e-15);
      const Vec3 off = difference(difference(p[v], sphere.center), scaled(normals[v], sphere.radius));
      EXPECT_NEAR(dot(off, off), 0, 1e-28);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Belts, SphereFacetsOf, testing::Values(2, 3, 4, 7, 32));

}  // namespace
}  // namespace pipeline
