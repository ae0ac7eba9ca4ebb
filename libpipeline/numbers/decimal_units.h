#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pipeline {

/// 10^0, 10^1 and so on.
template <typename Number, std::size_t kCount>
constexpr std::array<Number, kCount> powers_of_ten() {
  std::array<Number, kCount> powers{1};
  for (std::size_t n = 1; n < kCount; ++n) powers[n] = 10 * powers[n - 1];
  return powers;
}
/// 10^n for every n such that 10^n is exact in a double, and such that it fits in 64 bits.
constexpr auto kPowersOfTen = powers_of_ten<double, 23>();
constexpr auto kWholePowersOfTen = powers_of_ten<std::uint64_t, 20>();

// Rounding to n decimals. Such a decimal is a whole number of units of 10^-n, so a number is scaled by 10^n
// and rounded to a whole number. The scaled number is rounded to a double; the result is accepted only if
// that rounding cannot change it, otherwise the caller computes it exactly (A. Ziv, "Fast evaluation of
// elementary mathematical functions with correctly rounded last bit", ACM TOMS 17(3), 1991). Vector kernels
// repeat these formulas lane by lane, with these constants.

/// Doubles from 2^52 to 2^53 are whole numbers: adding this number and subtracting it again rounds to a whole
/// number.
constexpr double kWholeRounder = 0x1.8p52;

/// The whole number nearest to a number from -2^51 to 2^51, ties to even.
[[gnu::always_inline]] inline double nearest_whole(double value) {
  return (value + kWholeRounder) - kWholeRounder;
}

/// Half the distance between neighboring doubles from 1 to 2.
constexpr double kUnitRoundoff = 0x1p-53;

/// An upper bound on the relative error of a product of two doubles. (Proved, like the next constant, in
/// tests/proofs/rounding_test.g.)
constexpr double kProductError = 0x1p-52;

/// A number at a smaller distance from a whole number rounds to it, despite the rounding errors of the few
/// sums that make up such a distance.
constexpr double kBelowHalf = 0.5 - 0x1p-40;

/// The absolute value of a number in units of its last decimal. Always inlined, so that each kernel's loops
/// are compiled for its processor.
struct DecimalUnits {
  double scaled;  // the rounded product |value| * scale
  double whole;   // the whole number nearest to it, ties to even

  /// `scale` is 10^decimals, one of kPowersOfTen, which are exact.
  [[gnu::always_inline]] DecimalUnits(double value, double scale)
      : scaled(std::fabs(value) * scale), whole(nearest_whole(scaled)) {}

  /// The rounding test: true only if every number within `error`, in units, of the exact |value| * scale is
  /// nearer to `whole` than to any other whole number. It rejects ties, numbers from 2^51 units on (their
  /// product may be off by half a unit), infinities and NaN, and may reject a number right next to a tie.
  [[nodiscard, gnu::always_inline]] bool is_certain(double error = 0) const {
    return std::fabs(scaled - whole) + scaled * kProductError < kBelowHalf - error;
  }
};

}  // namespace pipeline
