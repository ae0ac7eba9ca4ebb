#include "libpipeline/numbers/shortest_decimal.h"

#include <array>
#include <bit>

#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {
namespace {

// A double is significand * 2^exponent with a 53-bit significand; these are the exponents of accepted values.
constexpr int kMinExponent = -40 - 52;
constexpr int kMaxExponent = 0;

// These exponents need the powers from 10^0 to 10^28.
constexpr int kMaxPower = 28;

/// 10^n = factor * 2^(log2 - 127) but for the last bit: the factor has 128 bits and is rounded up even where
/// it is exact, as the algorithm requires.
struct PowerOfTen {
  std::uint64_t high = 0;
  std::uint64_t low = 0;
  int log2 = 0;  // rounded down
};

constexpr auto kLongPowersOfTen = [] {
  std::array<PowerOfTen, kMaxPower + 1> powers{};
  UInt128 power = 1;
  for (PowerOfTen& p : powers) {
    p.log2 = 127;
    UInt128 factor = power;
    for (; (factor >> 127) == 0; factor <<= 1) --p.log2;
    ++factor;
    p.high = static_cast<std::uint64_t>(factor >> 64);
    p.low = static_cast<std::uint64_t>(factor);
    power *= 10;
  }
  return powers;
}();

/// floor(log10(2^exponent)), or floor(log10(3/4 * 2^exponent)), for small exponents.
constexpr int floor_log10(int exponent, bool of_three_quarters) {
  return (exponent * 1262611 - (of_three_quarters ? 524031 : 0)) >> 22;
}

/// power * factor / 2^128, rounded to odd: the last bit is set if anything was cut off.
std::uint64_t rounded_to_odd(const PowerOfTen& power, std::uint64_t factor) {
  const UInt128 low = static_cast<UInt128>(power.low) * factor;
  const UInt128 high = static_cast<UInt128>(power.high) * factor + (low >> 64);
  // The power is one unit too large in its last bit; the excess that this causes does not count as cut off.
  const bool is_inexact = static_cast<std::uint64_t>(high) > 1;
  return static_cast<std::uint64_t>(high >> 64) | (is_inexact ? 1 : 0);
}

/// A double taken apart: significand * 2^exponent = significand * 2^shift * power, in multiples of 10^k.
struct ScaledDouble {
  std::uint64_t significand;
  const PowerOfTen& power;
  int k;
  int shift;

  ScaledDouble(std::uint64_t whole_significand, int exponent, bool of_three_quarters)
      : significand(whole_significand),
        power(kLongPowersOfTen[static_cast<std::size_t>(-floor_log10(exponent, of_three_quarters))]),
        k(floor_log10(exponent, of_three_quarters)),
        shift(exponent + power.log2 + 1) {}
};

/// Decides by one product, with a fraction of 64 bits, instead of three. False if it is too close to a
/// border.
bool decide_by_fraction(const ScaledDouble& value, Decimal& decimal) {
  const std::uint64_t factor = value.significand << value.shift;
  const UInt128 low = static_cast<UInt128>(value.power.low) * factor;
  const UInt128 product = static_cast<UInt128>(value.power.high) * factor + (low >> 64);
  const auto units = static_cast<std::uint64_t>(product >> 64);
  const auto fraction = static_cast<std::uint64_t>(product);
  // In parts of 2^-60: the distances from the multiple of ten below and the one above, and half the gap
  // between two doubles, which is from 1/2 to 5.
  const std::uint64_t last_digit = units % 10;
  const std::uint64_t from_below = (last_digit << 60) + (fraction >> 4);
  const std::uint64_t from_above = (std::uint64_t{10} << 60) - from_below;
  const std::uint64_t half_gap = value.power.high >> (5 - value.shift);
  // Each of them is off by less than four parts.
  constexpr std::uint64_t kMargin = 16;
  constexpr std::uint64_t kHalf = std::uint64_t{1} << 63;
  const auto is_near = [](std::uint64_t a, std::uint64_t b) { return a - b + kMargin <= 2 * kMargin; };
  if (is_near(from_below, half_gap) || is_near(from_above, half_gap) || is_near(fraction, kHalf))
    return false;
  // Branch-free: whether a digit can be saved is unpredictable.
  const bool is_ten_below = from_below < half_gap;
  const bool is_ten_above = from_above < half_gap;
  const std::uint64_t shorter = units - last_digit + (is_ten_above ? 10 : 0);
  const std::uint64_t nearest = units + (fraction >> 63);
  decimal = {(is_ten_below | is_ten_above) ? shorter : nearest, value.k};
  return true;
}

/// Decides by the ends of the interval of numbers that round to this double.
[[gnu::noinline]] void decide_by_interval(const ScaledDouble& value, bool is_lower_gap_halved,
                                          Decimal& decimal) {
  const auto& [significand, power, k, shift] = value;
  // Four times the value and four times the ends of its rounding interval, in multiples of 10^k.
  const std::uint64_t center = rounded_to_odd(power, 4 * significand << shift);
  const std::uint64_t left =
      rounded_to_odd(power, (4 * significand - (is_lower_gap_halved ? 1 : 2)) << shift);
  const std::uint64_t right = rounded_to_odd(power, (4 * significand + 2) << shift);
  // The ends belong to the interval only if ties round to this value.
  const std::uint64_t is_odd = significand & 1;
  const auto contains = [&](std::uint64_t units) {
    return (left + is_odd <= 4 * units) & (4 * units <= right - is_odd);
  };
  const std::uint64_t below = center / 4;
  const std::uint64_t tens = below / 10 * 10;
  const bool tens_below = contains(tens);
  const bool tens_above = contains(tens + 10);
  const bool is_below = contains(below);
  const bool is_above = contains(below + 1);
  const std::uint64_t middle = 4 * below + 2;
  const bool is_nearer_above = (center > middle) | ((center == middle) & (below % 2 == 1));
  const bool round_up = (is_above & !is_below) | ((is_above == is_below) & is_nearer_above);
  // Branch-free: whether a digit can be saved is unpredictable.
  const std::uint64_t longer = below + (round_up ? 1 : 0);
  const std::uint64_t shorter = tens / 10 + (tens_above ? 1 : 0);
  const bool is_shorter = tens_below != tens_above;
  decimal.digits = longer + (shorter - longer) * (is_shorter ? 1 : 0);
  decimal.exponent = k + (is_shorter ? 1 : 0);
}

}  // namespace

bool shortest_decimal(double value, Decimal& decimal) {
  if (!(value >= 0x1p-40 && value < 0x1p53)) return false;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  constexpr std::uint64_t kHiddenBit = std::uint64_t{1} << 52;
  const std::uint64_t fraction = bits & (kHiddenBit - 1);
  const std::uint64_t significand = fraction | kHiddenBit;
  const int exponent = static_cast<int>(bits >> 52) - 1075;
  static_assert(floor_log10(kMinExponent, true) == -kMaxPower && floor_log10(kMaxExponent, false) == 0);
  // Below a power of two, the next smaller double is only half as far away.
  const bool is_lower_gap_halved = fraction == 0;
  const ScaledDouble scaled(significand, exponent, is_lower_gap_halved);
  if (!is_lower_gap_halved && decide_by_fraction(scaled, decimal)) return true;
  decide_by_interval(scaled, is_lower_gap_halved, decimal);
  return true;
}

}  // namespace pipeline
