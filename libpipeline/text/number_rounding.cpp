#include "libpipeline/text/number_rounding.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "libpipeline/numbers/decimal_units.h"

namespace pipeline {
namespace {

// A ball that contains a tie counts as the tie if its radius is below this fraction of a unit in the last
// printed place.
constexpr double kTieTolerance = 0x1p-20;
// In the shortest form, a ball around 0 is certainly 0 if it lies within this part of the input's size.
constexpr double kZeroTolerance = 0x1p-60;

/// A number as the sum of a whole number and the exact remainder, whose high part lies in [-1/2, 1/2].
struct SplitNumber {
  DoubleDouble whole;
  DoubleDouble rest;
};

SplitNumber split_at_whole(DoubleDouble t) {
  const double high = std::nearbyint(t.hi);
  const double low = std::nearbyint(t.lo);
  const DoubleDouble rest = two_sum(t.hi - high, t.lo - low);
  const double carry = std::nearbyint(rest.hi);
  return {two_sum(high, low) + DoubleDouble{carry, 0}, two_sum(rest.hi - carry, rest.lo)};
}

bool is_odd(DoubleDouble whole) {
  return std::fmod(std::fmod(whole.hi, 2) + std::fmod(whole.lo, 2), 2) != 0;
}

PrintableNumber round_to_decimals(DoubleDouble value, double error, int decimals) {
  const double scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  if (error == 0) return {value.hi, value.lo};
  // Up to 2^900 the scaled number cannot overflow; no decimal of a larger inexact number is known anyway.
  if (std::fabs(value.hi) > 0x1p900) return {value.hi, value.lo, false};
  const DoubleDouble scaled = value * scale;
  const double scaled_error = (error * scale + std::fabs(scaled.hi) * 0x1p-104) * (1 + 0x1p-40);
  auto [whole, rest] = split_at_whole(scaled);
  const double direction = std::copysign(1.0, rest.hi);
  // The distance from the tie, positive toward the whole number; exact where it is small.
  const double distance = (0.5 - std::fabs(rest.hi)) - direction * rest.lo;
  const bool may_be_tie = std::fabs(distance) <= scaled_error;
  const bool is_tie = may_be_tie && scaled_error <= kTieTolerance;
  if (is_tie ? is_odd(whole) : distance < 0) whole = whole + DoubleDouble{direction, 0};
  const bool is_certain = !may_be_tie || std::fabs(distance) + scaled_error <= kTieTolerance;
  const DoubleDouble decimal = whole / DoubleDouble{scale, 0};
  // A double within half a unit of the decimal prints as that decimal.
  if (std::fabs(whole.hi) < 0x1p51) return {decimal.hi, 0, is_certain};
  // A tie must print as the decimal chosen here; the printer rounds all other numbers correctly.
  if (is_tie) return {decimal.hi, decimal.lo, is_certain};
  return {value.hi, value.lo, is_certain};
}

}  // namespace

PrintableNumber round_to_shortest(const Ball& ball, double input_size) {
  // Both ends of most balls round to the midpoint's double; this test needs no neighbors. The bound is
  // enlarged by more than the sums lose.
  const auto [hi, lo] = ball.value();
  const double error = ball.error() + (ball.error() + std::fabs(lo)) * 0x1p-50;
  if (ball.exponent() == 0 && hi + (lo + error) == hi && hi + (lo - error) == hi) return {hi, 0};
  const double nearest = ball.nearest_double();
  if (ball.is_exact() || !std::isfinite(nearest)) return {nearest, 0};
  if (ball.sign() == 0) return {0, 0, ball.magnitude() <= kZeroTolerance * input_size};
  // Distances are measured on the midpoint's own scale; past +-3000 they are infinite.
  const auto shift = static_cast<int>(std::clamp<std::int64_t>(-ball.exponent(), -3000, 3000));
  const double rest = hi - std::ldexp(nearest, shift);  // nonzero only below a double's normal range
  const double direction = std::copysign(1.0, rest != 0 ? rest : lo);
  const double neighbor = std::nextafter(nearest, direction * HUGE_VAL);
  const double half_gap = std::fabs(std::ldexp(neighbor, shift) - std::ldexp(nearest, shift)) / 2;
  const double distance = (half_gap - std::fabs(rest)) - direction * lo;
  if (distance > ball.error()) return {nearest, 0};
  const double tolerance = 2 * half_gap * kTieTolerance;
  if (ball.error() > tolerance) return {nearest, 0, false};
  const bool nearest_is_even = std::bit_cast<std::uint64_t>(nearest) % 2 == 0;
  return {nearest_is_even ? nearest : neighbor, 0, std::fabs(distance) + ball.error() <= tolerance};
}

PrintableNumber round_to_text(const Ball& ball, NumberFormat format, double input_size) {
  if (format.shortest) return round_to_shortest(ball, input_size);
  const double nearest = ball.nearest_double();
  // A negative exponent means a number far below half a unit in the last decimal, for any count of decimals.
  if (!std::isfinite(nearest) || ball.exponent() < 0) return {nearest, 0, true};
  if (ball.exponent() > 0) {
    const int shift = static_cast<int>(ball.exponent());
    const DoubleDouble value = {nearest, std::ldexp(ball.value().lo, shift)};
    return round_to_decimals(value, std::ldexp(ball.error(), shift), format.decimals);
  }
  return round_to_decimals(ball.value(), ball.error(), format.decimals);
}

PrintablePoint round_to_text(const BallVec3& p, NumberFormat format, double input_size) {
  const PrintableNumber x = round_to_text(p.x, format, input_size),
                        y = round_to_text(p.y, format, input_size),
                        z = round_to_text(p.z, format, input_size);
  const auto is_infinite = [](const PrintableNumber& number) { return !std::isfinite(number.hi); };
  return {{x.hi, y.hi, z.hi},
          {x.lo, y.lo, z.lo},
          x.is_certain && y.is_certain && z.is_certain,
          is_infinite(x)   ? 'x'
          : is_infinite(y) ? 'y'
          : is_infinite(z) ? 'z'
                           : '\0'};
}

}  // namespace pipeline
