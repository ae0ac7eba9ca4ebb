#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {

// The operations that exact geometry needs of an integer type besides + - * and comparisons: bit_length,
// to_double and cut, under the same names for 64 bits, 128 bits and a FixedInt.

inline int bit_length(Int128 value) {
  return bit_length(static_cast<UInt128>(value < 0 ? ~value : value));
}

inline double to_double(std::int64_t value, int exponent) {
  return static_cast<double>(value) * power_of_two(-exponent);
}
inline double to_double(Int128 value, int exponent) {
  return to_double(value) * power_of_two(-exponent);
}

inline std::int64_t cut(std::int64_t value, int bits) {
  return value >> bits;
}
inline std::int64_t cut(Int128 value, int bits) {
  return static_cast<std::int64_t>(value >> bits);
}

/// A positive integer divisor with its inverse.
template <typename Int>
class Divisor {
 public:
  Divisor() = default;
  explicit Divisor(const Int& value) : value_(value) {
    if constexpr (kMayBeHuge) exponent_ = bit_length(value);
    inverse_ = 1 / in_range(value);
  }

  [[nodiscard]] const Int& value() const { return value_; }

  /// The smallest whole c in [0, most] with c * value >= dividend, or `most` if there is none; `most` is at
  /// most 2^20. The quotient in doubles is off by less than 2^-30, so it leaves two candidates; the exact
  /// remainder decides.
  [[nodiscard]] int quotient_rounded_up(const Int& dividend, int most) const {
    const double estimate = in_range(dividend) * inverse_;
    // The conversion truncates (-1, 0) to 0; smaller estimates are rare, and their branch is predicted.
    const double clamped = std::min(std::max(estimate, -1.0), static_cast<double>(most));
    const int near =
        static_cast<int>(clamped + 0.5);  // NOLINT(bugprone-incorrect-roundings): one less is as good
    return std::min(near + static_cast<int>(near * value_ < dividend), most);
  }

 private:
  static constexpr bool kMayBeHuge = !std::is_same_v<Int, std::int64_t> && !std::is_same_v<Int, Int128>;

  /// number / 2^exponent_ as a double; infinity where that is too large, which does no harm.
  [[nodiscard]] double in_range(const Int& number) const {
    if constexpr (kMayBeHuge) return to_double(number, exponent_);
    if constexpr (std::is_same_v<Int, Int128>) return to_double(number);
    if constexpr (std::is_same_v<Int, std::int64_t>) return static_cast<double>(number);
  }

  Int value_ = 1;
  int exponent_ = 0;
  double inverse_ = 1;
};

}  // namespace pipeline
