#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {

/// The product of up to four finite doubles.
struct ExactProduct {
  double a, b, c = 1, d = 1;
};

/// value * 2^exponent, rounded once: the relative error is at most 2^-102, and 0 stays exactly 0.
template <std::size_t Limbs>
Ball to_ball(const FixedInt<Limbs>& value, int exponent) {
  const int length = bit_length(value);
  // Two parts of 52 bits, each exact in a double.
  const int high_shift = std::max(length - 52, 0), low_shift = std::max(length - 104, 0);
  const std::int64_t high = cut(value, high_shift);
  const FixedInt<Limbs> rest = value - (FixedInt<Limbs>(high) << high_shift);
  const double low = std::ldexp(static_cast<double>(cut(rest, low_shift)), low_shift - high_shift);
  return Ball::with_error(fast_two_sum(static_cast<double>(high), low), low_shift == 0 ? 0 : 0x1p-52,
                          exponent + high_shift);
}

/// The sum of products, rounded once: the error is at most 2^-100 of the sum, and a sum of 0 is exactly 0.
/// Takes at most 18 products. Slow: for signs and digits that balls cannot decide.
Ball exact_sum(std::span<const ExactProduct> products);
inline Ball exact_sum(std::initializer_list<ExactProduct> products) {
  return exact_sum(std::span(products.begin(), products.size()));
}

/// The cross product (b - a) x (c - a) of the corners a, b and c, each coordinate rounded once.
BallVec3 exact_face_normal(const Triangle& p);

}  // namespace pipeline
