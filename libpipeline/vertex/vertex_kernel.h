#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

// The fast arithmetic on vertices. A kernel calculates a coordinate in doubles, or as an unevaluated sum of
// two (a pair), together with a bound on its error. If the bound does not determine the printed text, the
// vertex fails the rounding test, and the caller calculates it again in ball arithmetic. So the text of a
// correctly rounded coordinate does not depend on the kernel. With RoundingTestKind::finite every kernel does
// the same operations in the same order.

/// The condition for printing a calculated coordinate as it is.
enum class RoundingTestKind {
  finite,    // it is finite
  decimals,  // all numbers within its error bound have the same text with the requested decimals
  nearest    // all numbers within its error bound have the same nearest double
};

struct RoundingTest {
  RoundingTestKind kind = RoundingTestKind::finite;
  double scale = 1;  // 10^decimals
  /// True if there are so many decimals that a double's rounding error would show: calculates in pairs.
  bool needs_pairs = false;
};

/// The vertices of some triangles, axis by axis, so that a loop can work on several vertices at a time.
struct VertexBlock {
  static constexpr std::size_t kTriangles = 32;
  static constexpr std::size_t kSize = 3 * kTriangles;
  using Axis = std::array<double, kSize>;

  std::size_t count = 0;
  std::array<Axis, 3> p;  // x, y, z

  /// Stores the vertices of at most kTriangles triangles.
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
  [[nodiscard]] Triangle triangle(std::size_t index) const {
    return {vertex(3 * index), vertex(3 * index + 1), vertex(3 * index + 2)};
  }
};

/// The images of a block's vertices. The caller must recalculate an image that fails the rounding test.
struct ImageBlock : VertexBlock {
  std::array<std::uint64_t, kSize> passes_rounding_test;  // all bits or none
};

/// The sides on which a triangle's corners lie, as far as doubles can tell: sets of planes of the view volume
/// (bit i for kAllClipPlanes[i]).
struct CertainSides {
  std::uint64_t all_outside = 0;  // all corners lie outside, each by far more than rounding errors
  std::uint64_t none_inside = 0;  // no corner is surely inside
  std::uint64_t some_unsure = 0;  // a corner is not surely inside
};

/// The planes of the view volume that each vertex of a block is surely outside of, and surely inside of.
struct SideBlock {
  static constexpr std::uint64_t kAllPlanes = 0b111111;

  [[nodiscard]] CertainSides of_triangle(std::size_t index) const {
    const auto *const out = &outside[3 * index], *const in = &inside[3 * index];
    return {out[0] & out[1] & out[2], kAllPlanes & ~(in[0] | in[1] | in[2]),
            kAllPlanes & ~(in[0] & in[1] & in[2])};
  }

  std::array<std::uint64_t, VertexBlock::kSize> outside, inside;
};

/// An entry of a matrix, and the error that it adds to an image per unit of the coordinate it multiplies.
struct Coefficient {
  double value = 0;  // the nearest double
  double error = 0;  // added by a calculation in doubles
  DoubleDouble pair;
  double pair_error = 0;  // added by a calculation in pairs
  double is_nonzero = 0;  // 0 if the entry is exactly 0, else 1: to be summed instead of tested

  Coefficient() = default;
  /// `pair_error` is NaN, which fails every test, if the ball is outside the range where products of pairs
  /// are safe.
  explicit Coefficient(const Ball& number);
};

/// p' = rows * (p - origin, 1).
struct AffineCoefficients {
  Vec3 origin;
  std::array<std::array<Coefficient, 4>, 3> rows;
};

/// x' = (x_scale x + x_offset q) / w and likewise y', with w = -z and q = z for a perspective, w = q = 1 for
/// an orthographic projection. z' is (z_scale z + z_offset) / w in pairs; in doubles it comes from `near`,
/// `far` and `depth_range`, by a formula that keeps its digits, however close or far apart the planes are.
struct ProjectionCoefficients {
  bool is_perspective = true;
  std::array<Coefficient, 3> scales;   // of x, y, z
  std::array<Coefficient, 3> offsets;  // of x, y, z
  double near = 0;
  double far = 0;
  double depth_range = 0;  // far - near
  double clip_w = 1;       // w times this bounds the clip volume
};

/// A scale or an offset is NaN, which fails every test, if products with it may leave a double's range. The
/// planes of the clip volume are pulled in by `clip_inset`.
ProjectionCoefficients coefficients_of(const ProjectionTransform& projection, double clip_inset = 0);

/// A unit vector's image that is shorter may be nothing but rounding errors.
constexpr double kNearlyLost = 0x1p-40;

/// One implementation of the loops over a block's vertices.
struct VertexKernel {
  void (*transform)(const AffineCoefficients&, const RoundingTest&, const VertexBlock& p, ImageBlock& image);
  void (*project)(const ProjectionCoefficients&, const RoundingTest&, const VertexBlock& p_view,
                  ImageBlock& p_ndc);
  /// Finds the sides of all six planes if `beside`, else only of near and far.
  void (*find_sides)(const ProjectionCoefficients&, const VertexBlock& p_view, SideBlock& sides, bool beside);
  /// Replaces normals by their images, as NormalTransform (attribute_transform.h) does. Returns how many it
  /// replaced: it stops at a partial SIMD vector, or one with a normal of 0 or an image below kNearlyLost.
  std::size_t (*transform_normals)(const std::array<Vec3, 3>& rows, std::span<Vec3> normals);
};

extern const KernelTable<const VertexKernel*> kVertexKernels;

/// The kernel in use.
const VertexKernel& vertex_kernel();

/// The sides on which one triangle's corners lie.
CertainSides certain_sides(const ProjectionCoefficients& projection, const Triangle& p_view);

}  // namespace pipeline
