#include "libpipeline/vertex/vertex_kernel.h"

#include <cmath>
#include <limits>

#include "libpipeline/vertex/vertex_loops.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/vertex/vertex_kernel.cpp"
#include "libpipeline/numbers/lanes.h"

PIPELINE_BEGIN_KERNELS();

// Plain loops, which the compiler makes vectors of, but for normals.

#if HWY_NATIVE_FMA
using ProductError = FmaError;
#else
using ProductError = DekkerError;
#endif

void transform(const AffineCoefficients& m, const RoundingTest& test, const VertexBlock& p,
               ImageBlock& image) {
  transform_block<ProductError>(m, test, p, image);
}

void project(const ProjectionCoefficients& m, const RoundingTest& test, const VertexBlock& p,
             ImageBlock& p_ndc) {
  project_block<ProductError>(m, test, p, p_ndc);
}

void find_sides(const ProjectionCoefficients& m, const VertexBlock& p_view, SideBlock& sides, bool beside) {
  find_sides_of_block(m, p_view, sides, beside);
}

std::size_t transform_normals(const std::array<Vec3, 3>& rows, std::span<Vec3> normals) {
  const Vectors x = all(rows[0]), y = all(rows[1]), z = all(rows[2]);
  std::size_t done = 0;
  for (; done + kLanes <= normals.size(); done += kLanes) {
    double* const p = &normals[done].x;
    Vectors n;
    hn::LoadInterleaved3(kDoubles, p, n.x, n.y, n.z);
    n = unit(n);
    const Vectors image = {dot(x, n), dot(y, n), dot(z, n)};
    if (!hn::AllTrue(kDoubles, hn::Ge(largest_in(image), all(kNearlyLost)))) break;
    n = unit(image);
    hn::StoreInterleaved3(n.x, n.y, n.z, kDoubles, p);
  }
  return done;
}

constexpr VertexKernel kKernel = {transform, project, find_sides, transform_normals};

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {

Coefficient::Coefficient(const Ball& number) {
  if (number.is_exact_zero()) return;
  value = number.nearest_double();
  is_nonzero = 1;
  // tests/proofs/coordinate_in_doubles.g. Added to that are the ball's own error and the bits that a
  // subnormal value lacks.
  error = 8 * kUnitRoundoff * std::fabs(value) + number.radius() + 0x1p-1073;
  pair = number.value();
  // Far more than a calculation in pairs loses (tests/proofs/coordinate_in_pairs.g), and ball arithmetic on
  // the same numbers: a pair that passes the test is not a tie for the ball.
  pair_error = number.exponent() == 0 ? 0x1p-94 * std::fabs(value) + 8 * number.radius()
                                      : std::numeric_limits<double>::quiet_NaN();
}

const KernelTable<const VertexKernel*>& vertex_kernels() {
  static constexpr KernelTable<const VertexKernel*> kKernels = PIPELINE_KERNEL_TABLE(kKernel);
  return kKernels;
}

const VertexKernel& vertex_kernel() {
  static const VertexKernel& chosen = *chosen_kernel(vertex_kernels());
  return chosen;
}

CertainSides certain_sides(const ProjectionCoefficients& projection, const Triangle& p_view) {
  VertexBlock block;
  SideBlock sides;
  block.fill({&p_view, 1});
  vertex_kernel().find_sides(projection, block, sides, true);
  return sides.of_triangle(0);
}

}  // namespace pipeline

#endif
