#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/fixed_int.h"
#include "libpipeline/text/eight_digits.h"

namespace pipeline {

// Whole numbers and scaled numbers as text.

/// Prints a number; up to 8 characters past its end may be overwritten.
char* print_whole(char* out, std::uint64_t number);

/// Prints a number below 10^16 with exactly `count` digits, at most 16 and no fewer than it has; 16
/// characters may be written.
inline char* print_digits(char* out, SixteenDigits digits, int count) {
  UInt128 text = (static_cast<UInt128>(digits.last + kEightZeros) << 64) | (digits.first + kEightZeros);
  text >>= 8 * (16 - count);
  store_eight(out, static_cast<std::uint64_t>(text));
  store_eight(out + 8, static_cast<std::uint64_t>(text >> 64));
  return out + count;
}

/// Prints the digits before the point, mostly one.
inline char* print_before_point(char* out, std::uint64_t whole) {
  if (whole >= 10) return print_whole(out, whole);
  *out = static_cast<char>('0' + whole);
  return out + 1;
}

/// Prints '-' if the number is negative; branch-free, since the sign is unpredictable.
inline char* print_sign(char* out, bool is_negative) {
  *out = '-';
  return out + (is_negative ? 1 : 0);
}

/// Three digits and a zero byte for each number below 1000.
inline constexpr auto kTriples = [] {
  std::array<std::array<char, 4>, 1000> triples{};
  for (std::size_t i = 0; i < triples.size(); ++i)
    for (std::size_t digit = 3, rest = i; digit-- > 0; rest /= 10)
      triples[i][digit] = static_cast<char>('0' + rest % 10);
  return triples;
}();

/// Prints a number below 10^6 with six digits, as depths have them, and a byte for the caller to overwrite.
inline char* print_six_digits(char* out, std::uint32_t number) {
  std::memcpy(out, kTriples[number / 1000].data(), 4);
  std::memcpy(out + 3, kTriples[number % 1000].data(), 4);
  return out + 6;
}

constexpr int kMaxScaledDecimals = 15;

/// Prints a whole number of units of its last decimal. Inlined, so that a constant count of decimals costs no
/// division and no look-up.
[[gnu::always_inline]] inline char* print_units(char* out, bool is_negative, std::uint64_t units,
                                                int decimals) {
  const std::uint64_t units_per_one = kWholePowersOfTen[static_cast<std::size_t>(decimals)];
  const std::uint64_t whole = units / units_per_one, rest = units - whole * units_per_one;
  out = print_before_point(print_sign(out, is_negative & (units != 0)), whole);
  if (decimals == 0) return out;
  *out++ = '.';
  if (decimals == 6) return print_six_digits(out, static_cast<std::uint32_t>(rest));
  return print_digits(out, split_sixteen(rest), decimals);
}

/// The fast path of print_number for at most kMaxScaledDecimals: null where the number of units has more than
/// 51 bits, or lies so close to a tie that the rounding of the product matters. 16 characters after the end
/// may be overwritten.
[[gnu::always_inline]] inline char* print_scaled(char* out, double value, int decimals) {
  const DecimalUnits rounded(value, kPowersOfTen[static_cast<std::size_t>(decimals)]);
  if (!rounded.is_certain()) return nullptr;
  // Through a signed number, which processors convert in one instruction.
  const auto units = static_cast<std::uint64_t>(static_cast<std::int64_t>(rounded.whole));
  return print_units(out, value < 0, units, decimals);
}

}  // namespace pipeline
