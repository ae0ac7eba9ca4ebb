#include "libpipeline/raytracing/ray_caster.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/visibility/algorithms.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {
namespace {

ProjectionTransform projection_of(bool is_perspective) {
  const Located<Projection> given = {is_perspective ? Projection(Frustum{-1, 1, -1, 1, 1, 20})
                                                    : Projection(Orthographic{-4, 4, -4, 4, 1, 20}),
                                     {}};
  return clip_from_view(given);
}

TriangleBatch batch_of(const std::vector<Triangle>& triangles) {
  TriangleBatch batch;
  for (const Triangle& triangle : triangles) {
    const std::size_t line = 4 * batch.size() + 1;
    batch.add(triangle, batch.size(), {line, line + 1, line + 2});
  }
  return batch;
}

/// What a pixel shows: the place of the triangle in the projected text, and its depth.
struct Pixel {
  PixelTag tag = ~PixelTag{0};
  double depth = 0;
  friend bool operator==(const Pixel&, const Pixel&) = default;
};

std::vector<Pixel> traced(const TriangleBatch& p_view, const ProjectionTransform& projection,
                          const Viewport& screen) {
  TracedTriangles triangles(projection, "", false);
  triangles.add(p_view);
  ThreadPool pool(1);
  const Bvh bvh(boxes_of(triangles, PixelRays(projection, screen)), pool);
  triangles.keep_images_alone();
  RayCaster caster(triangles, bvh, projection, screen);
  std::vector<Pixel> pixels;
  for (int row = 0; row < screen.rows; ++row)
    for (int column = 0; column < screen.columns; ++column) {
      const auto seen = caster.cast(row, column);
      pixels.push_back(seen ? Pixel{seen->id, seen->depth} : Pixel{~PixelTag{0}, screen.rear});
    }
  return pixels;
}

std::vector<Pixel> drawn(const TriangleBatch& p_view, const ProjectionTransform& projection,
                         const Viewport& screen) {
  CoordinateRounder rounder(Precision::extended, kShortest, "");
  ProjectionStage stage(projection, ClipMode::automatic, CullMode::nothing, rounder);
  TriangleBatch p_ndc;
  stage.project(p_view, p_ndc);
  pass_through_text(p_ndc);
  ZBufferAlgorithm<CenterCoverage, DepthF64> visible(screen, ~PixelTag{0});
  for (std::size_t i = 0; i < p_ndc.size(); ++i)
    visible.draw(exact_triangle(p_ndc, i), static_cast<PixelTag>(i));
  std::vector<Pixel> pixels;
  visible.for_each_row([&](const VisibleRow& row) {
    for (std::size_t i = 0; i < row.tags.size(); ++i) pixels.push_back({row.tags[i], row.depths[i]});
  });
  return pixels;
}

void expect_same(const std::vector<Triangle>& triangles, bool is_perspective, const Viewport& screen) {
  const ProjectionTransform projection = projection_of(is_perspective);
  const TriangleBatch p_view = batch_of(triangles);
  ASSERT_EQ(traced(p_view, projection, screen), drawn(p_view, projection, screen));
}

class RandomTriangles : public ::testing::TestWithParam<bool> {};

TEST_P(RandomTriangles, AreThoseOfTheZBuffer) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> anywhere(-6, 6);
  for (int scene = 0; scene < 60; ++scene) {
    // Tidy coordinates put centers on edges and triangles in one place; some reach behind the eye.
    const double step = std::array{0.0, 1.0, 0.5, 0.1}[rng() % 4];
    const auto coordinate = [&](double shift) {
      const double value = anywhere(rng) + shift;
      return step == 0 ? value : std::round(value / step) * step;
    };
    std::vector<Triangle> triangles;
    for (int i = 0; i < 40; ++i) {
      Triangle triangle;
      for (Vec3& p : triangle) p = {coordinate(0), coordinate(0), coordinate(scene % 3 == 0 ? -4 : -8)};
      triangles.push_back(triangle);
    }
    const Viewport screen = {.columns = 16 + scene % 5,
                             .rows = 20,
                             .left = scene % 2 == 0 ? -1 : -0.6,
                             .bottom = -1,
                             .front = -1,
                             .rear = scene % 4 == 0 ? 0.9 : 1};
    expect_same(triangles, GetParam(), screen);
  }
}

TEST_P(RandomTriangles, InLayersOfOnePlaneAreThoseOfTheZBuffer) {
  std::mt19937_64 rng(2);
  for (const double gap : {0.0, 0x1p-52, 1e-12, 1e-7}) {
    std::vector<Triangle> triangles;
    for (int i = 0; i < 6; ++i) {
      const double z = -5 - gap * static_cast<double>(rng() % 3);
      triangles.push_back({Vec3{-4, -4, z}, Vec3{4, -4, z}, Vec3{4, 4, z}});
      triangles.push_back({Vec3{-4, -4, z}, Vec3{4, 4, z}, Vec3{-4, 4, z}});
    }
    expect_same(triangles, GetParam(), {.columns = 40, .rows = 40});
  }
}

INSTANTIATE_TEST_SUITE_P(RayCaster, RandomTriangles, ::testing::Bool());

TEST(RayCaster, OfEqualDepthsTheEarlierTriangleIsSeen) {
  const Triangle t = {Vec3{-9, -9, -5}, Vec3{9, -9, -5}, Vec3{0, 90, -5}};
  for (const Pixel& pixel : traced(batch_of({t, t, t}), projection_of(true), {.columns = 4, .rows = 4}))
    EXPECT_EQ(pixel.tag, 0u);
}

TEST(RayCaster, SeesNothingWithoutTriangles) {
  for (const Pixel& pixel : traced({}, projection_of(true), {.columns = 2, .rows = 2}))
    EXPECT_EQ(pixel.tag, ~PixelTag{0});
}

}  // namespace
}  // namespace pipeline
