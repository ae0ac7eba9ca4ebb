#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __x86_64__
#include <emmintrin.h>
#endif

namespace pipeline {

// The tests have never run with another byte order.
static_assert(std::endian::native == std::endian::little, "pipeline needs a little-endian processor");

inline bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Decimal digits, eight at a time in a 64-bit word.

/// Eight characters, the first in the lowest byte.
inline std::uint64_t load_eight(const char* p) {
  std::uint64_t eight = 0;
  std::memcpy(&eight, p, sizeof eight);
  return eight;
}

constexpr std::uint64_t kEightZeros = 0x3030303030303030;

/// A word with bit 7 set in each byte of `less_zeros` (eight characters minus kEightZeros) that is not a
/// digit; reliable up to and including the first such byte. 0 if all are digits.
inline std::uint64_t no_digits(std::uint64_t less_zeros) {
  return (less_zeros | (less_zeros + 0x7676767676767676)) & 0x8080808080808080;
}

/// The number formed by eight digits, one per byte, the first in the lowest byte. Joins digits into pairs,
/// pairs into fours, and fours into eights.
inline std::uint64_t join_digits(std::uint64_t digits) {
  const std::uint64_t pairs = digits * 10 + (digits >> 8);
  constexpr std::uint64_t kMask = 0x000000ff000000ff;
  const std::uint64_t outer = (pairs & kMask) * ((1'000'000ULL << 32) + 100);
  const std::uint64_t inner = ((pairs >> 16) & kMask) * ((10'000ULL << 32) + 1);
  return (outer + inner) >> 32;
}

/// The count of leading digits among eight characters, given minus kEightZeros.
inline std::size_t leading_digit_count(std::uint64_t less_zeros) {
  return static_cast<std::size_t>(std::countr_zero(no_digits(less_zeros))) / 8;
}

/// The number formed by the first `count` digits, 1 to 8: they are shifted to the end of the word, after
/// zeros.
inline std::uint64_t join_leading_digits(std::uint64_t less_zeros, std::size_t count) {
  return join_digits(less_zeros << (64 - 8 * count));
}

/// The inverse of join_digits: the digits of a number below 10^8, one per byte, the first in the lowest byte.
/// Divides by multiplying with rounded-up inverses, which is exact for four and for two digits.
inline std::uint64_t split_digits(std::uint32_t number) {
  const std::uint64_t fours = number / 10000 | static_cast<std::uint64_t>(number % 10000) << 32;
  const std::uint64_t hundreds = (fours * 10486 >> 20) & 0x0000007f0000007f;
  const std::uint64_t pairs = hundreds | (fours - 100 * hundreds) << 16;
  const std::uint64_t tens = (pairs * 103 >> 10) & 0x000f000f000f000f;
  return tens | (pairs - 10 * tens) << 8;
}

/// Sixteen digits, one per byte.
struct SixteenDigits {
  std::uint64_t first;
  std::uint64_t last;
};

/// The digits of a number below 10^16.
inline SixteenDigits split_sixteen(std::uint64_t number) {
  constexpr std::uint64_t kEightDigits = 100'000'000;
  const auto high = static_cast<std::uint32_t>(number / kEightDigits);
  const auto low = static_cast<std::uint32_t>(number % kEightDigits);
#ifdef __x86_64__
  const __m128i eights = _mm_set_epi64x(static_cast<std::int64_t>(low), static_cast<std::int64_t>(high));
  // x / 10000 for x < 10^8, in 64 bits.
  const __m128i upper = _mm_srli_epi64(_mm_mul_epu32(eights, _mm_set1_epi64x(0xd1b71759)), 45);
  const __m128i lower = _mm_sub_epi32(eights, _mm_mul_epu32(upper, _mm_set1_epi64x(10000)));
  const __m128i fours = _mm_or_si128(upper, _mm_slli_epi64(lower, 32));
  // x / 100 for x < 10^4, then x / 10 for x < 100, in 16 bits.
  const __m128i hundreds = _mm_srli_epi16(_mm_mulhi_epu16(fours, _mm_set1_epi16(5243)), 3);
  const __m128i rest = _mm_sub_epi16(fours, _mm_mullo_epi16(hundreds, _mm_set1_epi16(100)));
  const __m128i pairs = _mm_or_si128(hundreds, _mm_slli_epi32(rest, 16));
  const __m128i tens = _mm_mulhi_epu16(pairs, _mm_set1_epi16(6554));
  const __m128i ones = _mm_sub_epi16(pairs, _mm_mullo_epi16(tens, _mm_set1_epi16(10)));
  const __m128i digits = _mm_or_si128(tens, _mm_slli_epi16(ones, 8));
  return {static_cast<std::uint64_t>(_mm_cvtsi128_si64(digits)),
          static_cast<std::uint64_t>(_mm_cvtsi128_si64(_mm_unpackhi_epi64(digits, digits)))};
#else
  return {split_digits(high), split_digits(low)};
#endif
}

inline void store_eight(char* p, std::uint64_t eight) {
  std::memcpy(p, &eight, sizeof eight);
}

}  // namespace pipeline
