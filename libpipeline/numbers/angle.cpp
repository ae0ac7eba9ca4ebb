#include "libpipeline/numbers/angle.h"

#include <array>
#include <cmath>
#include <span>

#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {
namespace {

/// The nearest pair to 1 / n, with a relative error of at most 2^-107.
constexpr DoubleDouble inverse_pair(UInt128 n) {
  const BinaryInverse inverse = binary_inverse(n);
  DoubleDouble pair = {static_cast<double>(inverse.factor), 0};
  pair.lo = static_cast<double>(static_cast<Int128>(inverse.factor - static_cast<UInt128>(pair.hi)));
  for (int i = inverse.exponent; i < 0; ++i) pair = {pair.hi / 2, pair.lo / 2};
  return pair;
}

/// 1 / first!, 1 / (first + 2)! and so on.
constexpr std::array<DoubleDouble, 14> inverse_factorials(std::size_t first) {
  std::array<DoubleDouble, 14> inverses;
  UInt128 factorial = 1;
  for (std::size_t i = 0, n = 0; i < inverses.size(); ++i) {
    while (n < first + 2 * i) factorial *= ++n;
    inverses[i] = inverse_pair(factorial);
  }
  return inverses;
}

constexpr auto kInverseOddFactorials = inverse_factorials(1), kInverseEvenFactorials = inverse_factorials(2);

// pi / 180, with a relative error of at most 2^-109.
constexpr DoubleDouble kRadiansPerDegree = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};

// A bound on the relative error of either series (tests/proofs/angle_series.g).
constexpr double kSeriesError = 0x1p-99;

/// c0 - c1 t + c2 t^2 - ... by Horner's rule.
DoubleDouble alternating_polynomial(std::span<const DoubleDouble> coefficients, DoubleDouble t) {
  DoubleDouble sum;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = coefficients[i] - sum * t;
  return sum;
}

Ball with_relative_error(DoubleDouble value) {
  return Ball::with_error(value, std::fabs(value.hi) * kSeriesError);
}

/// sine_cosine_of_degrees for an angle in [-45, 45] degrees.
SineCosine sine_cosine_of_reduced(DoubleDouble degrees) {
  if (degrees.hi == 0) return {0, 1, 0};
  if (std::fabs(degrees.hi) < kTinyDegrees) {
    // sin x = x and 1 - cos x = x^2 / 2, far beyond the precision of a ball.
    const Ball angle = to_radians(Ball(degrees.hi) + Ball(degrees.lo));
    const Ball tiny_versine = angle * angle * Ball(0.5);
    return {angle, Ball(1) - tiny_versine, tiny_versine};
  }
  const DoubleDouble x = degrees * kRadiansPerDegree;
  const DoubleDouble square = x * x;
  const bool is_thirty = std::fabs(degrees.hi) == 30 && degrees.lo == 0;
  const Ball sine = is_thirty
                        ? Ball(std::copysign(0.5, degrees.hi))
                        : with_relative_error(alternating_polynomial(kInverseOddFactorials, square) * x);
  const Ball versine = with_relative_error(alternating_polynomial(kInverseEvenFactorials, square) * square);
  return {sine, Ball(1) - versine, versine};
}

}  // namespace

Ball to_radians(const Ball& degrees) {
  return degrees * Ball::with_error(kRadiansPerDegree, 0x1p-114);
}

SineCosine sine_cosine_of_degrees(DoubleDouble degrees) {
  // fmod is exact, and so are the sums: both remainders lie on the grid of the larger part.
  const DoubleDouble turned = two_sum(std::fmod(degrees.hi, 360), std::fmod(degrees.lo, 360));
  const double quarter_turns = std::nearbyint(turned.hi / 90);
  const DoubleDouble reduced = two_sum(turned.hi - 90 * quarter_turns, turned.lo);
  const SineCosine r = sine_cosine_of_reduced(reduced);
  switch (static_cast<int>(quarter_turns) & 3) {
    case 0:
      return r;
    case 1:
      return {r.cosine, -r.sine, Ball(1) + r.sine};
    case 2:
      return {-r.sine, -r.cosine, Ball(1) + r.cosine};
    default:
      return {-r.cosine, r.sine, Ball(1) - r.sine};
  }
}

}  // namespace pipeline
