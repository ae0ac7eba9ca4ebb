// No include guard: included once for each target, see numbers/vector_targets.h.

#include <bit>
#include <cstdint>
#include <limits>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/lanes.h"
#include "libpipeline/vertex/vertex_kernel.h"

PIPELINE_BEGIN_KERNELS();

// The arithmetic of all kernels (vertex_kernel.h) on coordinates, free of branches.

/// A coordinate and a bound on its error.
struct Estimate {
  Doubles value;
  Doubles error;
};
/// The estimate as a pair, |low| <= ulp(high) / 2.
struct PairEstimate {
  Doubles high;
  Doubles low;
  Doubles error;
  Mask is_zero;  // exactly
};

// ---- rounding tests; `value` becomes the double that is printed ----

/// nearest_whole of numbers/decimal_units.h, in each lane.
HWY_INLINE Doubles nearest_whole(Doubles value, double rounder = kWholeRounder) {
  return (value + all(rounder)) - all(rounder);
}

HWY_INLINE Mask is_finite(const Estimate& e, Doubles& value) {
  value = e.value;
  return hn::Le(hn::Abs(value), all(std::numeric_limits<double>::max()));
}

/// The rounding test of DecimalUnits.
HWY_INLINE Mask has_one_text(const Estimate& e, double scale, Doubles& value) {
  value = e.value;
  const Doubles scaled = hn::Abs(value) * all(scale), offset = scaled - nearest_whole(scaled);
  return hn::Lt(hn::Abs(offset) + scaled * all(kProductError), all(kBelowHalf) - e.error * all(scale));
}

/// The rounding test of a pair, whose product with the scale is exact up to the pair's error. Far enough from
/// a tie, the pair has the text of the nearest whole number of units, which may be any up to 2^53, so it is
/// found in two steps. Below `limit`, doubles lie closer than units, so the double nearest to that number has
/// the same text.
HWY_INLINE Mask has_one_text(const PairEstimate& e, double scale, Doubles& value) {
  constexpr std::uint64_t kExponent = 0x7ff0'0000'0000'0000;
  const double limit = std::bit_cast<double>(std::bit_cast<std::uint64_t>(0x1p53 / scale) & kExponent);
  const Pairs scaled = two_product(e.high, all(scale));
  const Doubles fours = nearest_whole(scaled.hi, 4 * kWholeRounder);
  const Doubles rest = (scaled.hi - fours) + (scaled.lo + e.low * all(scale));
  const Doubles units = nearest_whole(rest);
  const Doubles reach = hn::Abs(rest - units) + e.error * all(scale);
  value = (fours + units) / all(scale);
  return hn::And(hn::Lt(reach, all(kBelowHalf)), hn::Lt(hn::Abs(e.high), all(limit)));
}

/// True if both ends of the interval round to the same double, as does every number between them (A. Ziv,
/// "Fast evaluation of elementary mathematical functions with correctly rounded last bit", 1991). Accepts
/// only values far above the lower end of a double's range, so that the underflow of products is negligible
/// against the error.
HWY_INLINE Mask has_one_double(const PairEstimate& e, Doubles& value) {
  const Doubles error = e.error + hn::Abs(e.low) * all(0x1p-50);
  value = e.high;
  const Mask is_nearest =
      hn::And(hn::Eq(e.high + (e.low + error), e.high), hn::Eq(e.high + (e.low - error), e.high));
  return hn::Or(hn::And(is_nearest, hn::Ge(hn::Abs(e.high), all(0x1p-500))), e.is_zero);
}

template <RoundingTestKind kind>
HWY_INLINE Mask passes_rounding_test(const Estimate& e, double scale, Doubles& value) {
  if constexpr (kind == RoundingTestKind::finite) return is_finite(e, value);
  return has_one_text(e, scale, value);
}

template <RoundingTestKind kind>
HWY_INLINE Mask passes_rounding_test(const PairEstimate& e, double scale, Doubles& value) {
  if constexpr (kind == RoundingTestKind::nearest) return has_one_double(e, value);
  return has_one_text(e, scale, value);
}

// ---- products of pairs ----

/// a * b (tests/proofs/pair_product.g).
HWY_INLINE Pairs product(const DoubleDouble& a, const Pairs& b) {
  const Pairs high = two_product(all(a.hi), b.hi);
  return {high.hi, high.lo + (all(a.hi) * b.lo + all(a.lo) * b.hi)};
}

// ---- affine transforms ----

HWY_INLINE Estimate image_in_doubles(const std::array<Coefficient, 4>& row, const Vectors& p) {
  const auto& [a, b, c, d] = row;
  return {all(a.value) * p.x + all(b.value) * p.y + all(c.value) * p.z + all(d.value),
          // Products that underflow lose less than 2^-1070 together.
          all(a.error) * hn::Abs(p.x) + all(b.error) * hn::Abs(p.y) + all(c.error) * hn::Abs(p.z) +
              all(d.error) + all(0x1p-1070)};
}

/// The dot product in twice a double's precision (T. Ogita, S. Rump, S. Oishi, "Accurate sum and dot
/// product", 2005); its error: tests/proofs/coordinate_in_pairs.g.
HWY_INLINE PairEstimate image_in_pairs(const std::array<Coefficient, 4>& row, const std::array<Pairs, 3>& p) {
  const auto& [a, b, c, d] = row;
  const Pairs ax = product(a.pair, p[0]), by = product(b.pair, p[1]), cz = product(c.pair, p[2]);
  const Pairs two = two_sum(ax.hi, by.hi), three = two_sum(two.hi, cz.hi),
              four = two_sum(three.hi, all(d.pair.hi));
  const Doubles low = ((ax.lo + by.lo) + (cz.lo + all(d.pair.lo))) + ((two.lo + three.lo) + four.lo);
  const Pairs sum = two_sum(four.hi, low);
  const Doubles x = hn::Abs(p[0].hi), y = hn::Abs(p[1].hi), z = hn::Abs(p[2].hi);
  const Doubles error =
      all(a.pair_error) * x + all(b.pair_error) * y + all(c.pair_error) * z + all(d.pair_error);
  const Doubles nonzero =
      all(a.is_nonzero) * x + all(b.is_nonzero) * y + all(c.is_nonzero) * z + all(d.is_nonzero);
  return {sum.hi, sum.lo, error, hn::Eq(nonzero, all(0))};
}

// ---- projections ----

/// True for a w in front of the eye whose intermediate results stay in a double's range; for others, the
/// kernels have no result.
HWY_INLINE Mask is_safe_divisor(Doubles w) {
  return hn::And(hn::Gt(w, all(0x1p-400)), hn::Lt(w, all(0x1p400)));
}

/// (a + b) / divisor.
HWY_INLINE Estimate quotient_in_doubles(Doubles a, Doubles b, Doubles divisor) {
  // Products that underflow change a quotient by less than 2^-150.
  constexpr double kLost = 0x1p-150, kRelative = 8 * kUnitRoundoff;
  return {(a + b) / divisor, all(kRelative) * ((hn::Abs(a) + hn::Abs(b)) / divisor) + all(kLost)};
}

/// z in NDC, at a distance in front of the eye.
HWY_INLINE Estimate depth_in_doubles(const ProjectionCoefficients& m, Doubles distance, Doubles w) {
  const Doubles beyond_near = (distance - all(m.near)) * all(m.is_perspective ? m.far : 1);
  const Doubles before_far = (all(m.far) - distance) * all(m.is_perspective ? m.near : 1);
  return quotient_in_doubles(beyond_near, hn::Neg(before_far), w * all(m.depth_range));
}

/// (scale p + offset q) / w along one axis: the numerator as in image_in_pairs, the quotient with one
/// correction.
HWY_INLINE PairEstimate projected_in_pairs(const Coefficient& a, const Coefficient& b, Doubles v, Doubles q,
                                           Doubles w) {
  const Pairs scaled = product(a.pair, Pairs{v, all(0)}), shift = product(b.pair, Pairs{q, all(0)});
  const Pairs sum = two_sum(scaled.hi, shift.hi);
  const Pairs numerator = two_sum(sum.hi, sum.lo + (scaled.lo + shift.lo));
  const Doubles quotient = numerator.hi / w;
  const Pairs back = two_product(quotient, w);
  const Doubles remainder = ((numerator.hi - back.hi) - back.lo) + numerator.lo;
  const Pairs result = two_sum(quotient, remainder / w);
  const Doubles v_size = hn::Abs(v), q_size = hn::Abs(q);
  const Doubles error = (all(a.pair_error) * v_size + all(b.pair_error) * q_size) / w;
  const Doubles nonzero = all(a.is_nonzero) * v_size + all(b.is_nonzero) * q_size;
  return {result.hi, result.lo, error, hn::Eq(nonzero, all(0))};
}

PIPELINE_END_KERNELS();
