#include "libpipeline/vertex/vertex_kernel.h"

#include <cmath>
#include <cstddef>
#include <limits>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/vertex/vertex_loops.h"

namespace pipeline {
namespace {

void transform_portable(const AffineCoefficients& m, const RoundingTest& test, const VertexBlock& p,
                        ImageBlock& image) {
  transform_block<DekkerError>(m, test, p, image);
}

void project_portable(const ProjectionCoefficients& m, const RoundingTest& test, const VertexBlock& p,
                      ImageBlock& p_ndc) {
  project_block<DekkerError>(m, test, p, p_ndc);
}

#if defined(__x86_64__) && defined(__GNUC__)

// Four vertices at a time, with fused multiply-adds.

__attribute__((target("avx2,fma"))) void transform_avx2(const AffineCoefficients& m, const RoundingTest& test,
                                                        const VertexBlock& p, ImageBlock& image) {
  transform_block<FmaError>(m, test, p, image);
}

__attribute__((target("avx2,fma"))) void project_avx2(const ProjectionCoefficients& m,
                                                      const RoundingTest& test, const VertexBlock& p,
                                                      ImageBlock& p_ndc) {
  project_block<FmaError>(m, test, p, p_ndc);
}

#endif

struct KernelList {
  std::array<VertexKernel, 2> kernels{};
  std::size_t count = 0;

  KernelList() {
    kernels[count++] = {"portable", transform_portable, project_portable};
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      kernels[count++] = {"avx2", transform_avx2, project_avx2};
#endif
  }
};

}  // namespace

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

std::span<const VertexKernel> vertex_kernels() {
  static const KernelList list;
  return {list.kernels.data(), list.count};
}

const VertexKernel& vertex_kernel() {
  static const VertexKernel& chosen = chosen_kernel(vertex_kernels());
  return chosen;
}

}  // namespace pipeline
