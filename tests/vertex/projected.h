#pragma once

#include <gtest/gtest.h>

#include <initializer_list>

#include "libpipeline/vertex/projection.h"
#include "tests/vertex/printed_vertices.h"

namespace pipeline {

// Leaves x and y unchanged at distance 1; its near and far planes are at 1 and 100.
inline const ProjectionTransform kSimple = {true, 1, 0, 1, 0, 1, 100};

/// Corners at x, y = (0, 0), (1, 0) and (0, 1), in view space, with these z.
inline Triangle triangle_at(double z1, double z2, double z3) {
  return {Vec3{0, 0, z1}, Vec3{1, 0, z2}, Vec3{0, 1, z3}};
}

/// A batch with locations as in a text with four lines per triangle, from line 1 on.
inline TriangleBatch batch_of(std::initializer_list<Triangle> triangles) {
  TriangleBatch batch;
  for (const Triangle& t : triangles) {
    const std::size_t line = 4 * batch.size() + 1;
    batch.add(t, batch.size(), {line, line + 1, line + 2});
  }
  return batch;
}

/// The triangles in NDC, and the stage's counts.
struct Result {
  TriangleBatch p_ndc;
  ProjectionCounts counts;
};

/// Projects a batch read from stage2.txt; expects every printed digit to be certain.
inline Result projected(const TriangleBatch& p_view, const ProjectionTransform& projection, ClipMode clip,
                        CullMode cull = CullMode::nothing, NumberFormat format = {7},
                        Precision precision = Precision::extended, double clip_inset = 0) {
  CoordinateRounder rounder(precision, format, "stage2.txt");
  ProjectionStage stage(projection, clip, cull, rounder, clip_inset);
  Result result;
  stage.project(p_view, result.p_ndc);
  result.counts = stage.counts();
  EXPECT_FALSE(rounder.uncertain().first.is_known());
  return result;
}

inline ProjectionTransform transform_of(const Projection& projection) {
  return clip_from_view({projection, {}});
}

inline Perspective random_perspective(RandomNumbers& random) {
  const double fov_y = random.bits() % 2 == 0 ? random.between(1, 179) : random.whole(1, 179);
  const double near = std::exp2(random.between(-10, 10));
  return {fov_y, random.between(0.1, 179 / fov_y), near, near * (1 + std::exp2(random.between(-10, 30)))};
}

inline std::vector<Vec3> random_vertices_in_front(RandomNumbers& random, std::size_t count, double nearest) {
  std::vector<Vec3> vertices(count);
  for (Vec3& p : vertices)
    p = {random_coordinate(random, 1e6), random_coordinate(random, 1e6), -random.between(nearest, 1e6)};
  for (std::size_t i = 0; i < count; i += 4)
    vertices[i].z = -std::max(nearest, std::nearbyint(-vertices[i].z * 1e7) / 1e7);
  return vertices;
}

}  // namespace pipeline
