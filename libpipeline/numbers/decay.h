#pragma once

#include <array>
#include <cmath>

namespace pipeline {

/// e to the power -x, for x of at least 0, on every system with the same last bit: 1 for 0, and 0 where a
/// double has no more room. Of x, whole multiples of log 2 become a power of two; the rest r, |r| <= 0.35,
/// goes into the first 14 terms of the series, whose sum is off by less than 2^-52 (the next term is below
/// 0.35^14 / 14! = 2^-57). All in all, the relative error is below 2^-50.
inline double decay(double x) {
  if (!(x < 745.2)) return 0;
  // log 2 in two parts; the first has so few digits that its products with whole numbers are exact.
  constexpr double kLog2High = 0x1.62e42fefap-1, kLog2Low = 0x1.cf79abc9e3b3ap-40;
  const double whole = std::floor(x / 0x1.62e42fefa39efp-1 + 0.5);
  const double r = (whole * kLog2High - x) + whole * kLog2Low;
  double sum = 1;
  for (int n = 13; n >= 1; --n) sum = 1 + sum * r / n;
  return std::ldexp(sum, -static_cast<int>(whole));
}

}  // namespace pipeline
