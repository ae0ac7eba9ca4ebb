#pragma once

#include <cmath>
#include <cstddef>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/numbers/powers_of_ten.h"
#include "libpipeline/text/number_format.h"

namespace pipeline {

/// A coordinate ready to be printed: the exact sum hi + lo. `lo` is 0 unless a double cannot hold the
/// decimals that are asked for.
struct PrintableNumber {
  double hi = 0;
  double lo = 0;
  /// False where the ball was too wide to know every digit that will be printed.
  bool is_certain = true;
};

/// The number whose text is the correctly rounded text of every number in the ball; where the ball reaches a
/// point at which the rounding changes, and is narrower than 2^-20 of the last unit, it counts as that point
/// (ties to even). A ball around 0 that says no more than that is 0. Overflow gives an infinite hi.
PrintableNumber round_to_text(const Ball& ball, NumberFormat format);

/// The whole number next to a number from 0 to 2^51, ties to even.
inline double nearest_whole(double value) {
  // Beyond 2^52 doubles are whole numbers.
  constexpr double kRounder = 0x1.8p52;
  return (value + kRounder) - kRounder;
}

/// True if every number within `error` of `value` has the text of `value` itself. The test may say false for
/// a number that is safe, never true for one that is not; infinities and NaN are not safe.
inline bool rounds_safely(double value, double error, NumberFormat format) {
  if (format.shortest) return error == 0;
  const double scale = kPowersOfTen[static_cast<std::size_t>(format.decimals)];
  const double scaled = std::fabs(value) * scale;
  if (!(scaled < 0x1p51)) return false;
  // What the calculations here may lose.
  constexpr double kHalf = 0.5 - 0x1p-52;
  return std::fabs(scaled - nearest_whole(scaled)) + error * scale + scaled * 0x1p-52 < kHalf;
}

}  // namespace pipeline
