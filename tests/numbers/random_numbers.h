#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "libpipeline/numbers/double_double.h"

namespace pipeline {

/// Pseudorandom numbers, the same on every system (SplitMix64: G. Steele, D. Lea, C. Flood, "Fast
/// splittable pseudorandom number generators", 2014).
class RandomNumbers {
 public:
  explicit RandomNumbers(std::uint64_t seed) : state_(seed) {}

  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// A whole number from first to last, both included.
  int whole(int first, int last) {
    return first + static_cast<int>(bits() % (static_cast<std::uint64_t>(last - first) + 1));
  }
  /// A number in [low, high).
  double between(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
  }
  /// A number of either sign, with an absolute value in [2^first, 2^(last + 1)); often with few bits.
  double with_exponent(int first, int last) {
    double significand = 1 + static_cast<double>(bits() >> 12) * 0x1p-52;
    const std::uint64_t shape = bits();
    if (shape % 8 == 0) significand = 1;
    if (shape % 8 == 1) significand = 2 - 0x1p-52;
    if (shape % 8 == 2) significand = 1 + std::floor((significand - 1) * 16) / 16;
    return std::ldexp((shape >> 63) != 0 ? -significand : significand, whole(first, last));
  }
  /// Any finite double; all exponents are equally likely.
  double any_double() {
    const std::uint64_t pattern = bits();
    const double value = std::bit_cast<double>(pattern);
    return std::isfinite(value) ? value : std::bit_cast<double>(pattern & ~(std::uint64_t{1} << 62));
  }
  /// A normalized DoubleDouble whose low part is often 0, near its limit, or far below it.
  DoubleDouble double_double(int first, int last) {
    const double hi = with_exponent(first, last);
    const double ulp = std::ldexp(1.0, std::ilogb(hi) - 52);
    switch (bits() % 4) {
      case 0:
        return {hi, 0};
      case 1:
        return fast_two_sum(hi, std::copysign(ulp / 2 * (1 - 0x1p-53), between(-1, 1)));
      case 2:
        return fast_two_sum(hi, ulp / 2 * between(-1, 1));
      default:
        return fast_two_sum(hi, ulp * with_exponent(-60, -2));
    }
  }

 private:
  std::uint64_t state_;
};

}  // namespace pipeline
