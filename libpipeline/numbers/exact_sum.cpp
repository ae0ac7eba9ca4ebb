#include "libpipeline/numbers/exact_sum.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {
namespace {

/// A product of four doubles is significand * 2^exponent; an exponent is from 4 (-1073 - 53), where the
/// least double is 1/2 * 2^-1073, to 4 (1024 - 53).
constexpr int kLeastExponent = -4504, kLargestExponent = 3884, kSignificandBits = 212;
constexpr int kBits = kLargestExponent - kLeastExponent + kSignificandBits + 4;  // of the sum of 16
using Sum = FixedInt<(kBits + 63) / 64 + 1>;

/// The product in units of 2^kLeastExponent.
Sum in_units(const ExactProduct& product) {
  FixedInt<4> significand(1);
  int exponent = 0;
  for (const double factor : {product.a, product.b, product.c, product.d}) {
    int own = 0;
    const double fraction = std::frexp(factor, &own);
    significand = significand * FixedInt<4>(static_cast<std::int64_t>(std::ldexp(fraction, 53)));
    exponent += own - 53;
  }
  return Sum(significand) << (exponent - kLeastExponent);
}

}  // namespace

Ball exact_sum(std::initializer_list<ExactProduct> products) {
  assert(products.size() <= 16);
  Sum sum(0);
  for (const ExactProduct& product : products)
    if (product.a != 0 && product.b != 0 && product.c != 0 && product.d != 0) sum = sum + in_units(product);
  const int length = bit_length(sum);
  // Twice 52 bits of it, each of which a double holds.
  const int high_shift = std::max(length - 52, 0), low_shift = std::max(length - 104, 0);
  const std::int64_t high = cut(sum, high_shift);
  const Sum rest = sum - (Sum(high) << high_shift);
  const double low = std::ldexp(static_cast<double>(cut(rest, low_shift)), low_shift - high_shift);
  return Ball::with_error(fast_two_sum(static_cast<double>(high), low), low_shift == 0 ? 0 : 0x1p-52,
                          kLeastExponent + high_shift);
}

}  // namespace pipeline
