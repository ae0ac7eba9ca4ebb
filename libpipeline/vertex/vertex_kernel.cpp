#include "libpipeline/vertex/vertex_kernel.h"

#include <cmath>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/vertex/vertex_kernel.cpp"
#include "libpipeline/vertex/vertex_lanes.h"

PIPELINE_BEGIN_KERNELS();

constexpr hn::RebindToUnsigned<decltype(kDoubles)> kBits;
using Bits = hn::Vec<decltype(kBits)>;

// Lanes beyond a block's last vertex are calculated from arbitrary values, and never read.

HWY_INLINE Doubles coordinates(const VertexBlock& p, std::size_t axis, std::size_t i) {
  return hn::LoadU(kDoubles, &p.p[axis][i]);
}

/// Sets some vertices of a block to images, by `estimate(axis)`, and marks those that pass the test.
template <RoundingTestKind kind, typename Estimator>
HWY_INLINE void set_images(ImageBlock& image, std::size_t i, double scale, Mask are_safe,
                           const Estimator& estimate) {
#pragma GCC unroll 3
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Doubles value;
    are_safe = hn::And(are_safe, passes_rounding_test<kind>(estimate(axis), scale, value));
    hn::StoreU(value, kDoubles, &image.p[axis][i]);
  }
  hn::StoreU(hn::VecFromMask(kBits, hn::RebindMask(kBits, are_safe)), kBits, &image.passes_rounding_test[i]);
}

template <RoundingTestKind kind, bool in_pairs>
HWY_INLINE void transform_all(AffineCoefficients m, double scale, const VertexBlock& p, ImageBlock& image) {
  for (std::size_t i = 0; i < p.count; i += kLanes) {
    const Doubles x = coordinates(p, 0, i), y = coordinates(p, 1, i), z = coordinates(p, 2, i);
    set_images<kind>(image, i, scale, hn::Eq(all(0), all(0)), [&](std::size_t axis) HWY_ATTR {
      if constexpr (in_pairs)
        return image_in_pairs(m.rows[axis],
                              std::array{two_sum(x, all(-m.origin.x)), two_sum(y, all(-m.origin.y)),
                                         two_sum(z, all(-m.origin.z))});
      else
        return image_in_doubles(m.rows[axis], Vectors{x, y, z} - all(m.origin));
    });
  }
}

/// Calls `run` with two template arguments: the kind of test, and whether it takes pairs.
template <typename Run>
HWY_INLINE void by_test(const RoundingTest& test, const Run& run) {
  using Kind = RoundingTestKind;
  if (test.kind == Kind::finite)
    run.template operator()<Kind::finite, false>();
  else if (test.kind == Kind::nearest)
    run.template operator()<Kind::nearest, true>();
  else if (test.needs_pairs)
    run.template operator()<Kind::decimals, true>();
  else
    run.template operator()<Kind::decimals, false>();
}

void transform(const AffineCoefficients& m, const RoundingTest& test, const VertexBlock& p,
               ImageBlock& image) {
  image.count = p.count;
  by_test(test, [&]<RoundingTestKind kind, bool in_pairs>()
                    HWY_ATTR { transform_all<kind, in_pairs>(m, test.scale, p, image); });
}

template <RoundingTestKind kind, bool in_pairs>
HWY_INLINE void project_all(ProjectionCoefficients m, double scale, const VertexBlock& p, ImageBlock& p_ndc) {
  for (std::size_t i = 0; i < p.count; i += kLanes) {
    const Doubles z = coordinates(p, 2, i), distance = hn::Neg(z);
    const Doubles w = m.is_perspective ? distance : all(1), q = m.is_perspective ? z : all(1);
    set_images<kind>(p_ndc, i, scale, is_safe_divisor(w), [&](std::size_t axis) HWY_ATTR {
      const Doubles v = coordinates(p, axis, i);
      const Coefficient &a = m.scales[axis], &b = m.offsets[axis];
      if constexpr (in_pairs)
        return projected_in_pairs(a, b, v, axis == 2 ? all(1) : q, w);
      else
        return axis == 2 ? depth_in_doubles(m, distance, w)
                         : quotient_in_doubles(all(a.value) * v, all(b.value) * q, w);
    });
  }
}

void project(const ProjectionCoefficients& m, const RoundingTest& test, const VertexBlock& p,
             ImageBlock& p_ndc) {
  p_ndc.count = p.count;
  by_test(test, [&]<RoundingTestKind kind, bool in_pairs>()
                    HWY_ATTR { project_all<kind, in_pairs>(m, test.scale, p, p_ndc); });
}

/// Adds the two planes of an axis, bit `low` and the next. A vertex is at the distances w + v and w - v from
/// them, where v = scale p + offset q and w is the clip volume's. Each of these three terms is rounded less
/// often than a term of tests/proofs/coordinate_in_doubles.g, so a distance is off by less than 8 u times
/// their sum, and its sign is right above 2^-30 times that sum. For sums above 2^-400, a product's underflow
/// is negligible; a sum that overflows, or a coefficient that is NaN, fails every comparison.
HWY_INLINE void add_sides(const Coefficient& a, const Coefficient& b, std::uint64_t low, Doubles p, Doubles q,
                          Doubles w, Bits& outside, Bits& inside) {
  const Doubles scaled = all(a.value) * p, shift = all(b.value) * q, v = scaled + shift;
  const Doubles size = hn::Abs(scaled) + hn::Abs(shift) + hn::Abs(w), margin = all(0x1p-30) * size;
  const Mask is_in_range = hn::Gt(size, all(0x1p-400));
  const auto add = [&](Mask mask, std::uint64_t bit, Bits& bits) HWY_ATTR {
    const auto is_there = hn::RebindMask(kBits, hn::And(is_in_range, mask));
    bits = hn::Or(bits, hn::IfThenElseZero(is_there, hn::Set(kBits, bit)));
  };
  add(hn::Lt(w + v, hn::Neg(margin)), low, outside);
  add(hn::Lt(w - v, hn::Neg(margin)), 2 * low, outside);
  add(hn::Gt(w + v, margin), low, inside);
  add(hn::Gt(w - v, margin), 2 * low, inside);
}

void find_sides(const ProjectionCoefficients& m, const VertexBlock& p_view, SideBlock& sides, bool beside) {
  for (std::size_t i = 0; i < p_view.count; i += kLanes) {
    const Doubles z = coordinates(p_view, 2, i), q = m.is_perspective ? z : all(1);
    const Doubles w = (m.is_perspective ? hn::Neg(z) : all(1)) * all(m.clip_w);
    Bits outside = hn::Zero(kBits), inside = outside;
    add_sides(m.scales[2], m.offsets[2], 1, z, all(1), w, outside, inside);
    for (std::size_t axis = 0; beside && axis < 2; ++axis)
      add_sides(m.scales[axis], m.offsets[axis], axis == 0 ? 4 : 16, coordinates(p_view, axis, i), q, w,
                outside, inside);
    hn::StoreU(outside, kBits, &sides.outside[i]);
    hn::StoreU(inside, kBits, &sides.inside[i]);
  }
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
namespace {

/// The nearest double if products with it stay in range, and within one rounding of products with the number
/// itself; else NaN, which fails every rounding test.
double safe_double(const Ball& number) {
  if (number.is_exact_zero()) return 0;
  const double nearest = number.nearest_double();
  const double size = std::fabs(nearest);
  const bool is_fine = size > 0x1p-500 && size < 0x1p500 && number.radius() <= kUnitRoundoff * size;
  return is_fine ? nearest : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Coefficient::Coefficient(const Ball& number) {
  if (number.is_exact_zero()) return;
  value = number.nearest_double();
  is_nonzero = 1;
  // tests/proofs/coordinate_in_doubles.g. The ball's own error and the bits that a subnormal value lacks are
  // added.
  error = 8 * kUnitRoundoff * std::fabs(value) + number.radius() + 0x1p-1073;
  pair = number.value();
  // Far more than a calculation in pairs (tests/proofs/coordinate_in_pairs.g) or in balls loses: a pair that
  // passes the test is not a tie for the ball.
  pair_error = number.exponent() == 0 ? 0x1p-94 * std::fabs(value) + 8 * number.radius()
                                      : std::numeric_limits<double>::quiet_NaN();
}

ProjectionCoefficients coefficients_of(const ProjectionTransform& projection, double clip_inset) {
  const Ball near = projection.near;
  const Ball far = projection.far;
  const Ball z_scale = (projection.is_perspective ? -(far + near) : Ball(-2)) / (far - near);
  const Ball z_offset = (projection.is_perspective ? Ball(-2) * far * near : -(far + near)) / (far - near);
  ProjectionCoefficients coefficients;
  coefficients.is_perspective = projection.is_perspective;
  const std::array<Ball, 3> scales = {projection.x_scale, projection.y_scale, z_scale};
  const std::array<Ball, 3> offsets = {projection.x_offset, projection.y_offset, z_offset};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    coefficients.scales[axis] = Coefficient(scales[axis]);
    coefficients.scales[axis].value = safe_double(scales[axis]);
    coefficients.offsets[axis] = Coefficient(offsets[axis]);
    coefficients.offsets[axis].value = safe_double(offsets[axis]);
  }
  coefficients.near = projection.near;
  coefficients.far = projection.far;
  coefficients.depth_range = safe_double(far - near);
  coefficients.clip_w = 1 - clip_inset;
  return coefficients;
}

constinit const KernelTable<const VertexKernel*> kVertexKernels = PIPELINE_KERNEL_TABLE(kKernel);

const VertexKernel& vertex_kernel() {
  static const VertexKernel& chosen = *chosen_kernel(kVertexKernels);
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
