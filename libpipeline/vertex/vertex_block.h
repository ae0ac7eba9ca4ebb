#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// The coordinates of some vertices, axis by axis, so that a loop can work on several vertices at a time.
struct VertexBlock {
  static constexpr std::size_t kTriangles = 32;
  static constexpr std::size_t kSize = 3 * kTriangles;
  using Axis = std::array<double, kSize>;

  std::size_t count = 0;
  std::array<Axis, 3> p;  // x, y, z

  /// Takes the vertices of at most kTriangles triangles.
  void fill(std::span<const Triangle> triangles) {
    count = 0;
    for (const Triangle& triangle : triangles)
      for (const Vec3& vertex : triangle) {
        p[0][count] = vertex.x;
        p[1][count] = vertex.y;
        p[2][count] = vertex.z;
        ++count;
      }
  }
  [[nodiscard]] Vec3 vertex(std::size_t index) const { return {p[0][index], p[1][index], p[2][index]}; }
};

/// The images of a block's vertices, and which of them have to be calculated again by other means.
struct ImageBlock : VertexBlock {
  std::array<std::uint64_t, kSize> passes_rounding_test;
};

}  // namespace pipeline
