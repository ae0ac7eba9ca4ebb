#include "libpipeline/picture/surface_shader.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace pipeline {
namespace {

/// A screen of one pixel, with its center at (0, 0).
constexpr Viewport kOnePixel = {1, 1};

/// The color of the pixel if it shows this triangle, with a corner of each of these colors.
Color color_on(const Triangle& p_ndc, const std::array<Vec3, 3>& colors) {
  TriangleBatch batch;
  batch.add(p_ndc, 0, {});
  batch.attributes.colors = {colors};
  SurfaceShader shader(kOnePixel, {});
  const std::array<SurfaceShader::SurfaceId, 1> ids = {shader.add(batch, 0, Color())};
  return shader.shade(0, ids)[0];
}

constexpr std::array<Vec3, 3> kColors = {Vec3{10, 20, 30}, Vec3{40, 50, 60}, Vec3{70, 80, 90}};

TEST(SurfaceShader, APixelInTheMiddleHasTheMeanColor) {
  EXPECT_EQ(color_on({Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{0, 2, 0}}, kColors), Color(40, 50, 60));
}

// The nearest rule draws such triangles, too.
TEST(SurfaceShader, APixelOnATriangleWithoutAreaHasTheColorOfTheFirstCorner) {
  EXPECT_EQ(color_on({Vec3{-1, 0, 0}, Vec3{0.5, 0, 0}, Vec3{1, 0, 0}}, kColors), Color(10, 20, 30));
}

/// A batch of triangles that cover the pixel, each in one color; all have the same number.
TriangleBatch batch_of(const std::vector<Vec3>& colors) {
  TriangleBatch batch;
  for (const Vec3& color : colors) {
    batch.add({Vec3{-1, -1, 0}, Vec3{1, -1, 0}, Vec3{0, 2, 0}}, 0, {});
    batch.attributes.colors.push_back({color, color, color});
  }
  return batch;
}

TEST(SurfaceShader, TrianglesKeptHaveTheirColorsUnderTheirNewIds) {
  const TriangleBatch batch = batch_of({{1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}});
  SurfaceShader shader(kOnePixel, {});
  for (std::size_t i = 0; i < batch.size(); ++i) shader.add(batch, i, Color());
  KeptIds kept(4);
  kept.keep(1);
  kept.keep(3);
  kept.renumber();
  shader.keep(kept);
  EXPECT_EQ(shader.size(), 2u);
  const std::array<SurfaceShader::SurfaceId, 1> second = {kept.new_id(1)}, last = {kept.new_id(3)};
  EXPECT_EQ(shader.shade(0, second)[0], Color(2, 2, 2));
  EXPECT_EQ(shader.shade(0, last)[0], Color(4, 4, 4));
  const std::array<SurfaceShader::SurfaceId, 1> next = {shader.add(batch, 0, Color())};
  EXPECT_EQ(next[0], 2u);
  EXPECT_EQ(shader.shade(0, next)[0], Color(1, 1, 1));
}

TEST(SurfaceShader, AnIdShownBeforeHasTheColorOfItsNewTriangle) {
  const TriangleBatch batch = batch_of({{1, 1, 1}, {2, 2, 2}});
  SurfaceShader shader(kOnePixel, {});
  for (std::size_t i = 0; i < batch.size(); ++i) shader.add(batch, i, Color());
  const std::array<SurfaceShader::SurfaceId, 1> first = {0}, second = {1};
  EXPECT_EQ(shader.shade(0, first)[0], Color(1, 1, 1));
  EXPECT_EQ(shader.shade(0, second)[0], Color(2, 2, 2));
  EXPECT_EQ(shader.shade(0, first)[0], Color(1, 1, 1));
  KeptIds kept(2);
  kept.keep(1);
  kept.renumber();
  shader.keep(kept);
  EXPECT_EQ(shader.shade(0, first)[0], Color(2, 2, 2));
}

TEST(SurfaceShader, ColorsOfTrianglesThatAreNotKeptAreTheSame) {
  const Viewport screen = {9, 7};
  TriangleBatch batch;
  batch.add({Vec3{-4, -3, 0}, Vec3{4, -3, 0.5}, Vec3{0, 5, 0.25}}, 0, {});
  batch.attributes.colors = {kColors};
  batch.attributes.w = {{1, 3, 2}};
  SurfaceShader shader(screen, {});
  const SurfaceShader::Surface surface = shader.surface_of(batch, 0, Color());
  EXPECT_EQ(shader.size(), 0u);
  const std::vector<SurfaceShader::SurfaceId> ids(9, shader.add(batch, 0, Color()));
  for (int row = 0; row < screen.rows; ++row) {
    const auto colors = shader.shade(row, ids);
    for (int column = 0; column < screen.columns; ++column)
      EXPECT_EQ(shader.color_at(surface, row, column), colors[static_cast<std::size_t>(column)]);
  }
}

TEST(SurfaceShader, CountsWhatThreadsHaveShown) {
  const TriangleBatch batch = batch_of({{1, 1, 1}, {2, 2, 2}});
  SurfaceShader shader({2, 2}, {});
  for (std::size_t i = 0; i < batch.size(); ++i) shader.add(batch, i, Color());
  shader.set_workers(2);
  const std::array<SurfaceShader::SurfaceId, 2> dark = {0, SurfaceShader::kNoSurface}, both = {0, 1};
  shader.shade(0, dark, 1);
  EXPECT_FALSE(shader.shown().is_varied);
  shader.shade(1, both, 0);
  const ShownColors shown = shader.shown();
  EXPECT_TRUE(shown.is_varied);
  EXPECT_EQ(shown.visible, 0u);
  EXPECT_EQ(shown.dark[static_cast<std::size_t>(Darkness::unit_color)].count, 2u);
  const auto& small = shown.dark[static_cast<std::size_t>(Darkness::small_color)];
  EXPECT_EQ(small.count, 1u);
  EXPECT_EQ(small.greatest, 2);
}

}  // namespace
}  // namespace pipeline
