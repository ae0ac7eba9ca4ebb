#pragma once

#include "libpipeline/numbers/ball.h"
#include "libpipeline/text/number_printer.h"

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

}  // namespace pipeline
