#include "libpipeline/numbers/shortest_decimal.h"

#include <array>
#include <bit>

#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {
namespace {

// A double is significand * 2^exponent with a 53-bit significand. The exponents of accepted values, from -92
// to 0, need the powers from 10^0 to 10^28.
constexpr int kMinExponent = -40 - 52;
constexpr int kMaxPower = 28;

/// 10^n = factor * 2^(log2 - 127), exactly, by the factor's high and low 64 bits.
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
    p.high = static_cast<std::uint64_t>(factor >> 64);
    p.low = static_cast<std::uint64_t>(factor);
    power *= 10;
  }
  return powers;
}();

/// floor(log10(2^exponent)) for small exponents.
constexpr int floor_log10(int exponent) {
  return (exponent * 1262611) >> 22;
}
static_assert(floor_log10(kMinExponent) == -kMaxPower && floor_log10(0) == 0);

}  // namespace

bool shortest_decimal(double value, Decimal& decimal) {
  if (!(value >= 0x1p-40 && value < 0x1p53)) return false;
  constexpr std::uint64_t kHiddenBit = std::uint64_t{1} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const std::uint64_t rest = bits & (kHiddenBit - 1);
  // Below a power of two, the next smaller double is only half as far away.
  if (rest == 0) return false;
  const int exponent = static_cast<int>(bits >> 52) - 1075;
  // The value in units of 10^k, which are at most the gap between two doubles, with a fraction of 64 bits.
  const int k = floor_log10(exponent);
  const PowerOfTen& power = kLongPowersOfTen[static_cast<std::size_t>(-k)];
  const int shift = exponent + power.log2 + 1;
  const std::uint64_t factor = (rest | kHiddenBit) << shift;
  const UInt128 low = static_cast<UInt128>(power.low) * factor;
  const UInt128 product = static_cast<UInt128>(power.high) * factor + (low >> 64);
  const auto units = static_cast<std::uint64_t>(product >> 64);
  const auto fraction = static_cast<std::uint64_t>(product);
  // In parts of 2^-60: the distances from the multiple of ten below and the one above, and half the gap
  // between two doubles, which is from 1/2 to 5.
  const std::uint64_t last_digit = units % 10;
  const std::uint64_t from_below = (last_digit << 60) + (fraction >> 4);
  const std::uint64_t from_above = (std::uint64_t{10} << 60) - from_below;
  const std::uint64_t half_gap = power.high >> (5 - shift);
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
  decimal = {(is_ten_below | is_ten_above) ? shorter : nearest, k};
  return true;
}

}  // namespace pipeline
