#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/powers_of_ten.h"

namespace pipeline {

// The fast path for printing a number with a fixed count of decimals: it is scaled to a whole number of units
// of the last decimal, and its digits are looked up in a table of all groups of three digits.

struct DigitTriples {
  std::array<char, 4000> characters{};
  constexpr DigitTriples() {
    for (std::size_t i = 0; i < 1000; ++i) {
      characters[4 * i] = static_cast<char>('0' + i / 100);
      characters[4 * i + 1] = static_cast<char>('0' + i / 10 % 10);
      characters[4 * i + 2] = static_cast<char>('0' + i % 10);
    }
  }
};

inline constexpr DigitTriples kDigitTriples;

/// Writes three digits, and a fourth character for the caller to overwrite.
inline char* write_triple(char* out, std::uint32_t triple) {
  std::memcpy(out, kDigitTriples.characters.data() + std::size_t{4} * triple, 4);
  return out + 3;
}

inline char* write_whole(char* out, std::uint32_t whole) {
  std::array<char, 9> digits;
  std::size_t first = digits.size();
  for (; whole >= 10; whole /= 10) digits[--first] = static_cast<char>('0' + whole % 10);
  digits[--first] = static_cast<char>('0' + whole);
  std::memcpy(out, &digits[first], digits.size() - first);
  return out + (digits.size() - first);
}

/// Prints a number with 6 or 7 decimals, ties excluded, and returns the end of its text; the character after
/// it is overwritten, too. Null where the number has 10^15 units of the last decimal or more, is not finite,
/// or lies so close to a tie that only exact arithmetic can round it. A number that rounds to zero carries no
/// sign.
template <int decimals>
char* write_fixed(char* out, double value) {
  static_assert(decimals == 6 || decimals == 7);
  constexpr std::uint32_t kScale = kWholePowersOfTen[decimals];
  const DecimalUnits rounded(value, kScale);
  if (!(rounded.whole < 1e15) || !rounded.is_certain()) return nullptr;
  const auto units = static_cast<std::uint64_t>(rounded.whole);
  *out = '-';
  out += static_cast<int>(value < 0) & static_cast<int>(units != 0);
  std::uint32_t behind_point = static_cast<std::uint32_t>(units);
  if (units < std::uint64_t{10} * kScale) {
    const std::uint32_t whole = behind_point / kScale;
    *out++ = static_cast<char>('0' + whole);
    behind_point -= whole * kScale;
  } else {
    out = write_whole(out, static_cast<std::uint32_t>(units / kScale));
    behind_point = static_cast<std::uint32_t>(units % kScale);
  }
  *out++ = '.';
  if constexpr (decimals == 7) {
    *out++ = static_cast<char>('0' + behind_point / 1'000'000);
    behind_point %= 1'000'000;
  }
  return write_triple(write_triple(out, behind_point / 1000), behind_point % 1000);
}

}  // namespace pipeline
