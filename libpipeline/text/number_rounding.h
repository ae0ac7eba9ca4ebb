#pragma once

#include "libpipeline/numbers/ball.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {

/// A coordinate ready to be printed: the exact sum hi + lo. `lo` is 0 unless a double cannot hold the
/// requested decimals.
struct PrintableNumber {
  double hi = 0;
  double lo = 0;
  /// False if the ball was too wide to determine every printed digit (round_to_text).
  bool is_certain = true;
};

/// The number with the correctly rounded text of all numbers in the ball. A ball that contains a tie and is
/// narrower than 2^-20 of the last unit counts as the tie (rounded to even); it is certain if all of it lies
/// within 2^-20 of a unit of the tie. In the shortest form, a ball that contains 0 is 0; it is certain if no
/// number in it is larger than 2^-60 * `input_size`, the size of the numbers that were read: larger numbers
/// that cancel on the way do not raise this limit. Overflow gives an infinite hi.
PrintableNumber round_to_text(const Ball& ball, NumberFormat format, double input_size = 1);

/// A point ready to be printed.
struct PrintablePoint {
  Vec3 hi, lo;
  bool is_certain = true;  // true if all coordinates are
  char overflow = 0;       // the name of the first infinite coordinate, if there is one
};

/// The three coordinates by round_to_text.
PrintablePoint round_to_text(const BallVec3& p, NumberFormat format, double input_size);

/// round_to_text in the shortest form.
PrintableNumber round_to_shortest(const Ball& ball, double input_size = 1);

}  // namespace pipeline
