#include "libpipeline/picture/surface_shader.h"

#include <gtest/gtest.h>

#include <array>

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

}  // namespace
}  // namespace pipeline
