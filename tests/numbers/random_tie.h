#pragma once

#include <cmath>
#include <string>

#include "libpipeline/text/number_printer.h"
#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"

namespace pipeline {

// Holds any double, and any sum of two that are at most 700 binary places apart.
using Exact = Real<768>;

inline Exact power_of_ten(int exponent) {
  return exponent == 0 ? Exact(1) : Exact(10) * power_of_ten(exponent - 1);
}

/// A tie: halfway between two numbers of `decimals` decimals.
struct Tie {
  int decimals;
  Exact value;
  Exact unit;        // of the last decimal
  std::string text;  // ties to even
};

inline Tie random_tie(RandomNumbers& random, double largest_whole) {
  const int decimals = random.whole(0, kMaxDecimals);
  const double whole = std::floor(std::exp2(random.between(0, std::log2(largest_whole))));
  const int sign = random.bits() % 2 == 0 ? 1 : -1;
  const Exact scale = power_of_ten(decimals);
  const Exact even = round_to_even(Exact(whole) + Exact(0.5));
  // The quotient is rounded, but prints as the decimal.
  return {decimals, Exact(sign) * (Exact(whole) + Exact(0.5)) / scale, Exact(1) / scale,
          (Exact(sign) * even / scale).text(decimals)};
}

}  // namespace pipeline
