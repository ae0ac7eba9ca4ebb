#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/vertex/vertex_kernel.h"

// Inlined, so that each kernel's loops are compiled for its processor.
#define PIPELINE_LOOP inline __attribute__((always_inline))

namespace pipeline {

// The loops of all kernels (vertex_kernel.h), free of branches. Kernels differ only in `ProductError`, which
// calculates the exact rounding error of a product.

/// Splits the factors (T. Dekker, "A floating-point technique for extending the available precision", 1971),
/// for processors without a fused multiply-add: std::fma would be a call there.
struct DekkerError {
  PIPELINE_LOOP static double of(double a, double b, double product) {
    constexpr double kSplitter = 0x1p27 + 1;
    const double a_high = kSplitter * a - (kSplitter * a - a);
    const double b_high = kSplitter * b - (kSplitter * b - b);
    const double a_low = a - a_high;
    const double b_low = b - b_high;
    return ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low;
  }
};

/// For processors with a fused multiply-add.
struct FmaError {
  PIPELINE_LOOP static double of(double a, double b, double product) { return __builtin_fma(a, b, -product); }
};

/// A coordinate and a bound on its error.
struct Estimate {
  double value;
  double error;
};
/// The same for a pair, |low| <= ulp(high) / 2.
struct PairEstimate {
  double high;
  double low;
  double error;
  bool is_zero;  // exactly
};

// ---- rounding tests; `value` becomes the double that is printed ----

PIPELINE_LOOP bool is_finite(const Estimate& e, double& value) {
  value = e.value;
  return std::fabs(value) <= std::numeric_limits<double>::max();
}

PIPELINE_LOOP bool has_one_text(const Estimate& e, double scale, double& value) {
  value = e.value;
  return DecimalUnits(value, scale).is_certain(e.error * scale);
}

/// The rounding test of DecimalUnits for a pair: its product with the scale is exact but for the pair's
/// error. Far enough from a tie, it has the text of the nearest whole number of units, which is rounded to in
/// two steps, since a double up to 2^53 may be one. Below a power of two where doubles lie closer than units,
/// the nearest double to that many units has their text.
PIPELINE_LOOP bool has_one_text(const PairEstimate& e, double scale, auto rest, double& value) {
  constexpr double kFoursRounder = 4 * kWholeRounder;
  constexpr std::uint64_t kExponent = 0x7ff0'0000'0000'0000;
  const double limit = std::bit_cast<double>(std::bit_cast<std::uint64_t>(0x1p53 / scale) & kExponent);
  const double scaled = e.high * scale;
  const double scaled_low = rest.of(e.high, scale, scaled) + e.low * scale;
  const double fours = (scaled + kFoursRounder) - kFoursRounder;
  const double behind = (scaled - fours) + scaled_low;
  const double units = nearest_whole(behind);
  const double reach = std::fabs(behind - units) + e.error * scale;
  value = (fours + units) / scale;
  return (reach < kBelowHalf) & (std::fabs(e.high) < limit);
}

/// Both ends of the interval round to the same double, and so does every number between them (A. Ziv, "Fast
/// evaluation of elementary mathematical functions with correctly rounded last bit", 1991). Accepts only
/// values far above the lower end of a double's range, so that the underflow of products is negligible
/// against the error.
PIPELINE_LOOP bool has_one_double(const PairEstimate& e, double& value) {
  const double error = e.error + std::fabs(e.low) * 0x1p-50;
  value = e.high;
  const bool is_nearest = (e.high + (e.low + error) == e.high) & (e.high + (e.low - error) == e.high);
  return (is_nearest & (std::fabs(e.high) >= 0x1p-500)) | e.is_zero;
}

template <RoundingTestKind kind>
PIPELINE_LOOP bool passes_rounding_test(const Estimate& e, double scale, double& value) {
  if constexpr (kind == RoundingTestKind::finite) return is_finite(e, value);
  return has_one_text(e, scale, value);
}

template <RoundingTestKind kind, typename ProductError>
PIPELINE_LOOP bool passes_rounding_test(const PairEstimate& e, double scale, double& value) {
  if constexpr (kind == RoundingTestKind::nearest) return has_one_double(e, value);
  return has_one_text(e, scale, ProductError{}, value);
}

PIPELINE_LOOP std::uint64_t mask(bool condition) {
  return condition ? ~std::uint64_t{0} : 0;
}

// ---- products of pairs ----

/// a * b (tests/proofs/pair_product.g).
template <typename ProductError>
PIPELINE_LOOP DoubleDouble product(DoubleDouble a, DoubleDouble b) {
  const double high = a.hi * b.hi;
  return {high, ProductError::of(a.hi, b.hi, high) + (a.hi * b.lo + a.lo * b.hi)};
}

// ---- affine transforms ----

PIPELINE_LOOP Estimate image_in_doubles(const std::array<Coefficient, 4>& row, double x, double y, double z) {
  const auto& [a, b, c, d] = row;
  return {a.value * x + b.value * y + c.value * z + d.value,
          // Products that underflow lose less than 2^-1070 together.
          a.error * std::fabs(x) + b.error * std::fabs(y) + c.error * std::fabs(z) + d.error + 0x1p-1070};
}

/// The dot product in twice a double's precision (T. Ogita, S. Rump, S. Oishi, "Accurate sum and dot
/// product", 2005); its error: tests/proofs/coordinate_in_pairs.g.
template <typename ProductError>
PIPELINE_LOOP PairEstimate image_in_pairs(const std::array<Coefficient, 4>& row, DoubleDouble x,
                                          DoubleDouble y, DoubleDouble z) {
  const auto& [a, b, c, d] = row;
  const DoubleDouble ax = product<ProductError>(a.pair, x);
  const DoubleDouble by = product<ProductError>(b.pair, y);
  const DoubleDouble cz = product<ProductError>(c.pair, z);
  const DoubleDouble two = two_sum(ax.hi, by.hi);
  const DoubleDouble three = two_sum(two.hi, cz.hi);
  const DoubleDouble four = two_sum(three.hi, d.pair.hi);
  const double low = ((ax.lo + by.lo) + (cz.lo + d.pair.lo)) + ((two.lo + three.lo) + four.lo);
  const DoubleDouble sum = two_sum(four.hi, low);
  const double x_size = std::fabs(x.hi);
  const double y_size = std::fabs(y.hi);
  const double z_size = std::fabs(z.hi);
  const double error = a.pair_error * x_size + b.pair_error * y_size + c.pair_error * z_size + d.pair_error;
  const double nonzero = a.is_nonzero * x_size + b.is_nonzero * y_size + c.is_nonzero * z_size + d.is_nonzero;
  return {sum.hi, sum.lo, error, nonzero == 0};
}

template <RoundingTestKind kind>
PIPELINE_LOOP void transform_in_doubles(const AffineCoefficients& m, double scale, const VertexBlock& p,
                                        ImageBlock& image) {
  const auto [ox, oy, oz] = m.origin;
  const std::size_t count = p.count;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::array<Coefficient, 4> row = m.rows[axis];
    for (std::size_t i = 0; i < count; ++i) {
      const Estimate e = image_in_doubles(row, p.p[0][i] - ox, p.p[1][i] - oy, p.p[2][i] - oz);
      image.passes_rounding_test[i] &= mask(passes_rounding_test<kind>(e, scale, image.p[axis][i]));
    }
  }
}

template <RoundingTestKind kind, typename ProductError>
PIPELINE_LOOP void transform_in_pairs(const AffineCoefficients& m, double scale, const VertexBlock& p,
                                      ImageBlock& image) {
  const auto [ox, oy, oz] = m.origin;
  const std::size_t count = p.count;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::array<Coefficient, 4> row = m.rows[axis];
    for (std::size_t i = 0; i < count; ++i) {
      const PairEstimate e = image_in_pairs<ProductError>(row, two_sum(p.p[0][i], -ox),
                                                          two_sum(p.p[1][i], -oy), two_sum(p.p[2][i], -oz));
      image.passes_rounding_test[i] &=
          mask(passes_rounding_test<kind, ProductError>(e, scale, image.p[axis][i]));
    }
  }
}

template <typename ProductError>
PIPELINE_LOOP void transform_block(const AffineCoefficients& m, const RoundingTest& test,
                                   const VertexBlock& p, ImageBlock& image) {
  using Kind = RoundingTestKind;
  image.count = p.count;
  for (std::size_t i = 0; i < p.count; ++i) image.passes_rounding_test[i] = ~std::uint64_t{0};
  if (test.kind == Kind::finite) {
    transform_in_doubles<Kind::finite>(m, test.scale, p, image);
  } else if (test.kind == Kind::nearest) {
    transform_in_pairs<Kind::nearest, ProductError>(m, test.scale, p, image);
  } else if (test.needs_pairs) {
    transform_in_pairs<Kind::decimals, ProductError>(m, test.scale, p, image);
  } else {
    transform_in_doubles<Kind::decimals>(m, test.scale, p, image);
  }
}

// ---- projections ----

/// For any other w, behind the eye included, the kernels have no result: intermediate results of a w outside
/// these bounds may leave a double's range.
PIPELINE_LOOP bool is_safe_divisor(double w) {
  return (w > 0x1p-400) & (w < 0x1p400);
}

template <RoundingTestKind kind, bool is_perspective>
PIPELINE_LOOP void project_in_doubles(const ProjectionCoefficients& m, double scale, const VertexBlock& p,
                                      ImageBlock& p_ndc) {
  // Products that underflow change a quotient by less than 2^-150.
  constexpr double kLost = 0x1p-150;
  constexpr double kRelative = 8 * kUnitRoundoff;
  const std::size_t count = p.count;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const double coefficient = m.scales[axis].value;
    const double offset = m.offsets[axis].value;
    for (std::size_t i = 0; i < count; ++i) {
      const double z = p.p[2][i];
      const double w = is_perspective ? -z : 1;
      const double scaled = coefficient * p.p[axis][i];
      const double shift = offset * (is_perspective ? z : 1);
      const Estimate e = {(scaled + shift) / w,
                          kRelative * ((std::fabs(scaled) + std::fabs(shift)) / w) + kLost};
      p_ndc.passes_rounding_test[i] &=
          mask(passes_rounding_test<kind>(e, scale, p_ndc.p[axis][i])) & mask(is_safe_divisor(w));
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double distance = -p.p[2][i];
    const double w = is_perspective ? distance : 1;
    const double beyond_near = (distance - m.near) * (is_perspective ? m.far : 1);
    const double before_far = (m.far - distance) * (is_perspective ? m.near : 1);
    const double depth_scale = w * m.depth_range;
    const Estimate e = {(beyond_near - before_far) / depth_scale,
                        kRelative * ((std::fabs(beyond_near) + std::fabs(before_far)) / depth_scale) + kLost};
    p_ndc.passes_rounding_test[i] &= mask(passes_rounding_test<kind>(e, scale, p_ndc.p[2][i]));
  }
}

/// (scale p + offset q) / w along one axis: the numerator as in image_in_pairs, the quotient with one
/// correction. With a shift, q is z, else 1: a choice within the loop would keep it from being vectorized.
template <RoundingTestKind kind, typename ProductError, bool is_perspective, bool has_shift>
PIPELINE_LOOP void project_axis_in_pairs(const ProjectionCoefficients& m, std::size_t axis, double scale,
                                         const VertexBlock& p, ImageBlock& p_ndc) {
  const std::size_t count = p.count;
  const Coefficient a = m.scales[axis];
  const Coefficient b = m.offsets[axis];
  for (std::size_t i = 0; i < count; ++i) {
    const double z = p.p[2][i];
    const double w = is_perspective ? -z : 1;
    const double q = has_shift ? z : 1;
    const double v = p.p[axis][i];
    const DoubleDouble scaled = product<ProductError>(a.pair, {v, 0});
    const DoubleDouble shift = product<ProductError>(b.pair, {q, 0});
    const DoubleDouble sum = two_sum(scaled.hi, shift.hi);
    const DoubleDouble numerator = two_sum(sum.hi, sum.lo + (scaled.lo + shift.lo));
    const double quotient = numerator.hi / w;
    const double back = quotient * w;
    const double remainder = ((numerator.hi - back) - ProductError::of(quotient, w, back)) + numerator.lo;
    const DoubleDouble result = two_sum(quotient, remainder / w);
    const double v_size = std::fabs(v);
    const double q_size = std::fabs(q);
    const double error = (a.pair_error * v_size + b.pair_error * q_size) / w;
    const bool is_zero = a.is_nonzero * v_size + b.is_nonzero * q_size == 0;
    const PairEstimate e = {result.hi, result.lo, error, is_zero};
    p_ndc.passes_rounding_test[i] &=
        mask(passes_rounding_test<kind, ProductError>(e, scale, p_ndc.p[axis][i])) & mask(is_safe_divisor(w));
  }
}

template <RoundingTestKind kind, typename ProductError, bool is_perspective>
PIPELINE_LOOP void project_in_pairs(const ProjectionCoefficients& m, double scale, const VertexBlock& p,
                                    ImageBlock& p_ndc) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    project_axis_in_pairs<kind, ProductError, is_perspective, is_perspective>(m, axis, scale, p, p_ndc);
  project_axis_in_pairs<kind, ProductError, is_perspective, false>(m, 2, scale, p, p_ndc);
}

template <typename ProductError, bool is_perspective>
PIPELINE_LOOP void project_all(const ProjectionCoefficients& m, const RoundingTest& test,
                               const VertexBlock& p, ImageBlock& p_ndc) {
  using Kind = RoundingTestKind;
  if (test.kind == Kind::finite) {
    project_in_doubles<Kind::finite, is_perspective>(m, test.scale, p, p_ndc);
  } else if (test.kind == Kind::nearest) {
    project_in_pairs<Kind::nearest, ProductError, is_perspective>(m, test.scale, p, p_ndc);
  } else if (test.needs_pairs) {
    project_in_pairs<Kind::decimals, ProductError, is_perspective>(m, test.scale, p, p_ndc);
  } else {
    project_in_doubles<Kind::decimals, is_perspective>(m, test.scale, p, p_ndc);
  }
}

template <typename ProductError>
PIPELINE_LOOP void project_block(const ProjectionCoefficients& m, const RoundingTest& test,
                                 const VertexBlock& p, ImageBlock& p_ndc) {
  p_ndc.count = p.count;
  for (std::size_t i = 0; i < p.count; ++i) p_ndc.passes_rounding_test[i] = ~std::uint64_t{0};
  if (m.is_perspective) {
    project_all<ProductError, true>(m, test, p, p_ndc);
  } else {
    project_all<ProductError, false>(m, test, p, p_ndc);
  }
}

// ---- sides of the view volume ----

/// The two planes of an axis, `low` and the bit after it. A vertex is at the distances w + v and w - v from
/// them, where v = scale p + offset q and w is that of the clip volume. Each of these three terms is rounded
/// less often than a term of tests/proofs/coordinate_in_doubles.g, so a distance is off by less than 8 u of
/// their sum, and one of 2^-30 of that sum has the right sign. Sums above 2^-400 make the underflow of a
/// product negligible; a sum that overflows, or a coefficient that is NaN, fails every comparison.
template <bool is_perspective, bool has_shift>
PIPELINE_LOOP void add_sides(const ProjectionCoefficients& m, std::size_t axis, std::uint64_t low,
                             const VertexBlock& p, SideBlock& sides) {
  const std::size_t count = p.count;
  const double scale = m.scales[axis].value, offset = m.offsets[axis].value, clip_w = m.clip_w;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = p.p[2][i];
    const double w = (is_perspective ? -z : 1) * clip_w;
    const double scaled = scale * p.p[axis][i], shift = offset * (has_shift ? z : 1);
    const double v = scaled + shift;
    const double size = std::fabs(scaled) + std::fabs(shift) + std::fabs(w), margin = 0x1p-30 * size;
    const std::uint64_t is_in_range = mask(size > 0x1p-400);
    sides.outside[i] |= is_in_range & ((mask(w + v < -margin) & low) | (mask(w - v < -margin) & (2 * low)));
    sides.inside[i] |= is_in_range & ((mask(w + v > margin) & low) | (mask(w - v > margin) & (2 * low)));
  }
}

template <bool is_perspective>
PIPELINE_LOOP void add_all_sides(const ProjectionCoefficients& m, const VertexBlock& p, SideBlock& sides,
                                 bool beside) {
  add_sides<is_perspective, false>(m, 2, 1, p, sides);
  if (!beside) return;
  add_sides<is_perspective, is_perspective>(m, 0, 4, p, sides);
  add_sides<is_perspective, is_perspective>(m, 1, 16, p, sides);
}

PIPELINE_LOOP void find_sides_of_block(const ProjectionCoefficients& m, const VertexBlock& p,
                                       SideBlock& sides, bool beside) {
  for (std::size_t i = 0; i < p.count; ++i) sides.outside[i] = sides.inside[i] = 0;
  if (m.is_perspective) {
    add_all_sides<true>(m, p, sides, beside);
  } else {
    add_all_sides<false>(m, p, sides, beside);
  }
}

}  // namespace pipeline
