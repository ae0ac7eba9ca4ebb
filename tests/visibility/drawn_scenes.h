#pragma once

#include <vector>

#include "libpipeline/scene/color.h"
#include "libpipeline/visibility/algorithms.h"
#include "tests/numbers/random_numbers.h"
#include "tests/visibility/frame.h"

namespace pipeline {

/// Triangle after triangle, each as a whole.
template <typename Visible>
Frame drawn_one_by_one(const std::vector<Triangle>& scene, const Viewport& screen) {
  Visible visible(screen);
  TriangleColors colors;
  for (std::size_t i = 0; i < scene.size(); ++i) visible.draw({scene[i]}, colors.of(i));
  return frame_of(visible);
}

/// Tiny and huge triangles, on and off the screen, many at one of few depths, so that some are equal.
inline std::vector<Triangle> random_scene(int triangle_count, std::uint64_t seed) {
  RandomNumbers random(seed);
  std::vector<Triangle> scene;
  for (int i = 0; i < triangle_count; ++i) {
    const double size = i % 7 == 0 ? 3 : (i % 7 == 1 ? 1e6 : 0.05);
    const Vec3 location = {random.between(-1.2, 1.2), random.between(-1.2, 1.2), i % 3 / 4.0};
    const double depth_range = i % 2 == 0 ? 0 : 0.5;
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {location.x + random.between(-size, size), location.y + random.between(-size, size),
           location.z + random.between(-depth_range, depth_range)};
    scene.push_back(triangle);
  }
  return scene;
}

/// Nearly all of them small, some from the top to the bottom, at three depths.
inline std::vector<Triangle> scene_of_small_triangles(int triangle_count) {
  RandomNumbers random(2);
  std::vector<Triangle> scene;
  for (int i = 0; i < triangle_count; ++i) {
    const double size = i % 101 == 3 ? 0.9 : 0.02;
    const Vec3 location = {random.between(-1, 1), random.between(-1, 1), i % 3 / 4.0};
    Triangle triangle;
    for (Vec3& p : triangle)
      p = {location.x + random.between(-size, size), location.y + random.between(-size, size), location.z};
    scene.push_back(triangle);
  }
  return scene;
}

}  // namespace pipeline
