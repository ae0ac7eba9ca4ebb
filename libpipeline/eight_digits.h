#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace pipeline {

// Decimal digits, eight at a time in a 64-bit word.

/// Eight characters as they stand, the first in the lowest byte.
inline std::uint64_t load_eight(const char* p) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, p, sizeof eight);
  if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
  return eight;
}

constexpr std::uint64_t kEightZeros = 0x3030303030303030;

/// Bit 7 of each byte of `less_zeros` (eight characters minus kEightZeros) that is no digit, right up to the
/// first such byte; 0 if all are digits.
inline std::uint64_t no_digits(std::uint64_t less_zeros) {
  return (less_zeros | (less_zeros + 0x7676767676767676)) & 0x8080808080808080;
}

/// The number eight digits make, each in a byte, the first in the lowest: pairs, fours and eights are joined.
inline std::uint64_t join_digits(std::uint64_t digits) {
  const std::uint64_t pairs = digits * 10 + (digits >> 8);
  constexpr std::uint64_t kMask = 0x000000ff000000ff;
  const std::uint64_t outer = (pairs & kMask) * ((1'000'000ULL << 32) + 100);
  const std::uint64_t inner = ((pairs >> 16) & kMask) * ((10'000ULL << 32) + 1);
  return (outer + inner) >> 32;
}

/// The opposite: the digits of a number below 10^8, each in a byte, the first in the lowest. Quotients are
/// products with rounded-up inverses, right for four and for two digits.
inline std::uint64_t split_digits(std::uint32_t number) {
  const std::uint64_t fours = number / 10000 | static_cast<std::uint64_t>(number % 10000) << 32;
  const std::uint64_t hundreds = (fours * 10486 >> 20) & 0x0000007f0000007f;
  const std::uint64_t pairs = hundreds | (fours - 100 * hundreds) << 16;
  const std::uint64_t tens = (pairs * 103 >> 10) & 0x000f000f000f000f;
  return tens | (pairs - 10 * tens) << 8;
}

inline void store_eight(char* p, std::uint64_t eight) {
  if constexpr (std::endian::native == std::endian::big) eight = __builtin_bswap64(eight);
  std::memcpy(p, &eight, sizeof eight);
}

}  // namespace pipeline
