#pragma once

#include "libpipeline/numbers/ball.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {

/// A coordinate ready to be printed: the exact sum hi + lo. `lo` is 0 unless a double cannot hold the
/// requested decimals.
struct PrintableNumber {
  double hi = 0;
  double lo = 0;
  /// False if the ball was too wide to determine every printed digit.
  bool is_certain = true;
};

/// The number whose text is the correctly rounded text of every number in the ball. A ball that contains a
/// tie and is narrower than 2^-20 of the last unit counts as the tie (rounded to even). In the shortest form,
/// a ball that contains 0 becomes 0. On overflow, hi is infinite.
PrintableNumber round_to_text(const Ball& ball, NumberFormat format);

}  // namespace pipeline
