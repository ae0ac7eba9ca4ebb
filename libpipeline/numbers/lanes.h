// No include guard: included once for each target, see numbers/vector_targets.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/numbers/vector_targets.h"

PIPELINE_BEGIN_KERNELS();

namespace hn = hwy::HWY_NAMESPACE;

// The types of all kernels: the doubles in a vector register and, made of these, vectors as in
// numbers/vec_math.h and pairs as in numbers/double_double.h. Every kernel does the same operations in the
// same order in each lane.

// A source may limit the count of lanes.
#ifndef PIPELINE_MAX_LANES
#define PIPELINE_MAX_LANES 8
#endif
constexpr hn::CappedTag<double, PIPELINE_MAX_LANES> kDoubles;
constexpr std::size_t kLanes = hn::MaxLanes(kDoubles);
using Doubles = hn::Vec<decltype(kDoubles)>;
using Mask = hn::Mask<decltype(kDoubles)>;

HWY_INLINE Doubles all(double value) {
  return hn::Set(kDoubles, value);
}
HWY_INLINE Doubles choose(Mask mask, Doubles yes, Doubles no) {
  return hn::IfThenElse(mask, yes, no);
}

/// One bit per lane; at most sixteen lanes.
template <typename Lanes>
HWY_INLINE unsigned bits_of(Lanes lanes, hn::Mask<Lanes> mask) {
  std::array<std::uint8_t, 8> bytes;
  hn::StoreMaskBits(lanes, mask, bytes.data());
  std::uint16_t bits = 0;
  std::memcpy(&bits, bytes.data(), hn::MaxLanes(lanes) > 8 ? 2 : 1);
  return bits;
}
HWY_INLINE unsigned bits_of(Mask mask) {
  return bits_of(kDoubles, mask);
}

using Numbers = std::array<double, kLanes>;

HWY_INLINE Numbers numbers_of(Doubles value) {
  Numbers numbers;
  hn::StoreU(value, kDoubles, numbers.data());
  return numbers;
}
HWY_INLINE double number_in(Doubles value, std::size_t lane) {
  return numbers_of(value)[lane];
}

/// A Vec3 in each lane.
struct Vectors {
  Doubles x;
  Doubles y;
  Doubles z;
};

HWY_INLINE Vectors all(const Vec3& v) {
  return {all(v.x), all(v.y), all(v.z)};
}
HWY_INLINE Vectors choose(Mask mask, const Vectors& yes, const Vectors& no) {
  return {choose(mask, yes.x, no.x), choose(mask, yes.y, no.y), choose(mask, yes.z, no.z)};
}
HWY_INLINE Vectors operator+(const Vectors& a, const Vectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE Vectors operator*(const Vectors& a, const Vectors& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
HWY_INLINE Vectors operator*(const Vectors& v, Doubles factor) {
  return {v.x * factor, v.y * factor, v.z * factor};
}
HWY_INLINE Vectors operator/(const Vectors& v, Doubles divisor) {
  return {v.x / divisor, v.y / divisor, v.z / divisor};
}
HWY_INLINE Doubles dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// The largest magnitude in each lane.
HWY_INLINE Doubles largest_in(const Vectors& v) {
#if HWY_TARGET == HWY_SCALAR  // without Highway's treatment of NaN
  return all(std::max(std::max(std::fabs(v.x.raw), std::fabs(v.y.raw)), std::fabs(v.z.raw)));
#else
  return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
#endif
}

/// The unit vector as in numbers/vec_math.h, but NaN for 0: no comparison accepts NaN.
HWY_INLINE Vectors unit(const Vectors& v) {
  const Vectors near_1 = v / largest_in(v);
  return near_1 / hn::Sqrt(dot(near_1, near_1));
}

/// A DoubleDouble in each lane. Every kernel gets the same bits: the error of a product is exact, with or
/// without fused operations.
struct Pairs {
  Doubles hi;
  Doubles lo;
};

HWY_INLINE Pairs all(const DoubleDouble& value) {
  return {all(value.hi), all(value.lo)};
}
HWY_INLINE Pairs choose(Mask mask, const Pairs& yes, const Pairs& no) {
  return {choose(mask, yes.hi, no.hi), choose(mask, yes.lo, no.lo)};
}
/// a + b exactly.
HWY_INLINE Pairs two_sum(Doubles a, Doubles b) {
  const Doubles sum = a + b, b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}
HWY_INLINE Pairs fast_two_sum(Doubles a, Doubles b) {
  const Doubles sum = a + b;
  return {sum, b - (sum - a)};
}
/// a * b exactly. Where the processor has no fused operations, the factors are split (T. Dekker, "A
/// floating-point technique for extending the available precision", 1971).
HWY_INLINE Pairs two_product(Doubles a, Doubles b) {
  const Doubles product = a * b;
#if HWY_NATIVE_FMA
  return {product, hn::MulSub(a, b, product)};
#else
  const Doubles splitter = all(0x1p27 + 1), wide_a = splitter * a, wide_b = splitter * b;
  const Doubles a_high = wide_a - (wide_a - a), b_high = wide_b - (wide_b - b);
  const Doubles a_low = a - a_high, b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
#endif
}

// Errors: a sum is within 2^-103 (|a| + |b|), a product or quotient within 2^-101 of itself.
HWY_INLINE Pairs operator+(const Pairs& a, const Pairs& b) {
  const Pairs high = two_sum(a.hi, b.hi);
  return fast_two_sum(high.hi, high.lo + (a.lo + b.lo));
}
HWY_INLINE Pairs operator-(const Pairs& a, const Pairs& b) {
  return a + Pairs{hn::Neg(b.hi), hn::Neg(b.lo)};
}
HWY_INLINE Pairs operator*(const Pairs& a, const Pairs& b) {
  const Pairs high = two_product(a.hi, b.hi);
  return fast_two_sum(high.hi, high.lo + (a.hi * b.lo + a.lo * b.hi));
}
HWY_INLINE Pairs operator*(const Pairs& a, Doubles b) {
  const Pairs high = two_product(a.hi, b);
  return fast_two_sum(high.hi, high.lo + a.lo * b);
}
HWY_INLINE Pairs operator/(const Pairs& a, const Pairs& b) {
  const Doubles quotient = a.hi / b.hi;
  return fast_two_sum(quotient, (a - b * quotient).hi / b.hi);
}

PIPELINE_END_KERNELS();
