#include "libpipeline/raytracing/surface_caster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>
#include <vector>

#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/raytracing/traced_triangles.h"

namespace pipeline {
namespace {

struct Scene {
  explicit Scene(const std::vector<Triangle>& all) {
    TriangleBatch batch;
    for (const Triangle& triangle : all) {
      const std::size_t line = 4 * batch.size() + 1;
      batch.add(triangle, batch.size(), {line, line + 1, line + 2});
    }
    triangles.keep_dropped();
    triangles.add(batch);
    ThreadPool pool(1);
    bvh = Bvh(boxes_of(triangles, PixelRays(projection, {8, 8}), RaysOfBoxes::any), pool);
  }
  ProjectionTransform projection = clip_from_view({Frustum{-1, 1, -1, 1, 1, 20}, {}});
  TracedTriangles triangles{projection, "", false};
  Bvh bvh;
};

/// The parameter where a line meets a triangle's inside, by Cramer's rule in long doubles; none near an edge.
std::optional<long double> meeting(const Ray& ray, const Triangle& p) {
  using Long = std::array<long double, 3>;
  const auto minus = [](const Vec3& a, const Vec3& b) {
    return Long{static_cast<long double>(a.x) - b.x, static_cast<long double>(a.y) - b.y,
                static_cast<long double>(a.z) - b.z};
  };
  const auto det = [](const Long& a, const Long& b, const Long& c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  };
  const Long a = minus(p[1], p[0]), b = minus(p[2], p[0]), s = minus(ray.origin, p[0]);
  const Long d = minus({}, ray.direction);
  const long double whole = det(a, b, d);
  const long double u = det(s, b, d) / whole, v = det(a, s, d) / whole;
  if (!(u > 1e-9L && v > 1e-9L && u + v < 1 - 1e-9L)) return std::nullopt;
  return det(a, b, s) / whole;
}

std::vector<Triangle> random_triangles(std::mt19937_64& rng, int count) {
  std::uniform_real_distribution<double> place(-8, 8), size(-2, 2);
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = {place(rng), place(rng), place(rng)};
    triangles.push_back({p,
                         {p.x + size(rng), p.y + size(rng), p.z + size(rng)},
                         {p.x + size(rng), p.y + size(rng), p.z + size(rng)}});
  }
  return triangles;
}

/// In front of the eye, behind it, and cut by its plane: every one is met once.
TEST(SurfaceCaster, FindsTheNearestOfAllTriangles) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> place(-9, 9);
  const std::vector<Triangle> all = random_triangles(rng, 400);
  const Scene scene(all);
  SurfaceCaster caster(scene.triangles, scene.bvh);
  int hit_count = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Ray ray = {{place(rng), place(rng), place(rng)},
                     {place(rng), place(rng), i % 5 == 0 ? 0 : place(rng)}};
    std::optional<long double> nearest;
    std::size_t number = 0;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (const auto t = meeting(ray, all[k]); t && *t > 1e-9L && (!nearest || *t < *nearest)) {
        nearest = t;
        number = k;
      }
    const auto found = caster.nearest({ray});
    ASSERT_EQ(found.id != kNoSurface, nearest.has_value()) << i;
    if (!nearest) continue;
    ++hit_count;
    ASSERT_EQ(caster.number(found.id), number);
    ASSERT_NEAR(found.t, static_cast<double>(*nearest), 1e-9 * (1 + found.t));
    const Vec3 normal =
        cross(difference(all[number][1], all[number][0]), difference(all[number][2], all[number][0]));
    ASSERT_EQ(found.is_front, dot(normal, ray.direction) < 0);
  }
  EXPECT_GT(hit_count, 5'000);
}

TEST(SurfaceCaster, CrossesWhatStandsBetweenInItsOrder) {
  std::mt19937_64 rng(2);
  std::uniform_real_distribution<double> place(-9, 9);
  const std::vector<Triangle> all = random_triangles(rng, 400);
  const Scene scene(all);
  SurfaceCaster caster(scene.triangles, scene.bvh);
  std::vector<SurfaceCaster::Crossing> crossings;
  std::size_t crossing_count = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Ray ray = {{place(rng), place(rng), place(rng)}, {place(rng), place(rng), place(rng)}};
    std::vector<std::pair<double, std::uint64_t>> expected;
    for (std::size_t k = 0; k < all.size(); ++k)
      if (const auto t = meeting(ray, all[k]); t && *t > 1e-9L && *t < 1)
        expected.emplace_back(static_cast<double>(*t), k);
    std::ranges::sort(expected);
    ASSERT_TRUE(caster.cross({ray}, crossings, [](std::uint32_t) { return false; }));
    ASSERT_EQ(crossings.size(), expected.size()) << i;
    for (std::size_t k = 0; k < expected.size(); ++k)
      ASSERT_EQ(caster.number(crossings[k].id), expected[k].second);
    ASSERT_EQ(caster.cross({ray}, crossings, [](std::uint32_t) { return true; }), expected.empty());
    crossing_count += expected.size();
  }
  EXPECT_GT(crossing_count, 1'000U);
}

/// Through the edge that two triangles share, both are met at one place.
TEST(SurfaceCaster, CrossesOneOfTwoNeighborsAtTheirEdge) {
  const Scene scene(
      {{Vec3{-1, -1, -5}, {1, -1, -5}, {0, 1, -5}}, {Vec3{-1, -1, -5}, {0, 1, -5}, {-2, 1, -5}}});
  SurfaceCaster caster(scene.triangles, scene.bvh);
  std::vector<SurfaceCaster::Crossing> crossings;
  const Ray ray = {{-0.5, 0, -1}, {0, 0, -8}};
  ASSERT_TRUE(caster.cross({ray}, crossings, [](std::uint32_t) { return false; }));
  ASSERT_EQ(crossings.size(), 1U);
  EXPECT_EQ(crossings[0].t, 0.5);
  EXPECT_TRUE(crossings[0].is_front);
  EXPECT_EQ(crossings[0].cosine, 1);
  EXPECT_EQ(caster.nearest({ray}).id, 0U);
}

}  // namespace
}  // namespace pipeline
