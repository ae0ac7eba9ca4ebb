// No include guard: included once for each target, see numbers/vector_targets.h.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/numbers/vector_targets.h"

PIPELINE_BEGIN_KERNELS();

namespace hn = hwy::HWY_NAMESPACE;

// The functions of numbers/vec_math.h for as many vectors at a time as a vector of the processor has doubles.
// Every kernel does the same operations in the same order in each lane.

constexpr hn::ScalableTag<double> kDoubles;
constexpr std::size_t kLanes = hn::MaxLanes(kDoubles);
using Doubles = hn::Vec<decltype(kDoubles)>;

HWY_INLINE Doubles all(double value) {
  return hn::Set(kDoubles, value);
}

/// A vector in each lane.
struct Vectors {
  Doubles x;
  Doubles y;
  Doubles z;
};

HWY_INLINE Vectors all(const Vec3& v) {
  return {all(v.x), all(v.y), all(v.z)};
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
#if HWY_TARGET == HWY_SCALAR  // without what Highway does about NaN
  return all(std::max(std::max(std::fabs(v.x.raw), std::fabs(v.y.raw)), std::fabs(v.z.raw)));
#else
  return hn::Max(hn::Max(hn::Abs(v.x), hn::Abs(v.y)), hn::Abs(v.z));
#endif
}

/// As in numbers/vec_math.h, but NaN for 0: no comparison accepts that.
HWY_INLINE Vectors unit(const Vectors& v) {
  const Vectors near_1 = v / largest_in(v);
  return near_1 / hn::Sqrt(dot(near_1, near_1));
}

PIPELINE_END_KERNELS();
