#include "libpipeline/text/wide_decimal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "libpipeline/text/eight_digits.h"

namespace pipeline {
namespace {

constexpr int kMaxExactDecimals = 1074;  // those of 2^-1074

/// Enough decimals to write a number exactly: its last bit is worth 2^(ilogb - 52) or more, and 2^-n has n
/// decimals.
int exact_decimals(double value) {
  return value == 0 ? 0 : std::clamp(52 - std::ilogb(value), 0, kMaxExactDecimals);
}

/// The exact digits of a number's absolute value, without the point; eight zeros precede them to complete a
/// block.
struct ExactDigits {
  static constexpr std::size_t kZeros = 8;
  std::array<char, kZeros + 309 + 1 + kMaxExactDecimals> characters;
  char* end;

  /// `decimals` is at least 1 and makes the number exact.
  ExactDigits(double value, int decimals) {
    std::fill_n(characters.data(), kZeros, '0');
    char* const limit = characters.data() + characters.size();
    end = std::to_chars(first(), limit, std::fabs(value), std::chars_format::fixed, decimals).ptr;
    end = std::copy(end - decimals, end, end - decimals - 1);
  }
  char* first() { return characters.data() + kZeros; }
};

/// a = |a + sign * b|, where both have the same count of decimals and b is not the larger one.
void add(ExactDigits& a, ExactDigits& b, int sign) {
  constexpr std::int64_t kEightDigits = 100'000'000;
  const auto eight_at = [](const char* p) {
    return static_cast<std::int64_t>(join_digits(load_eight(p) - kEightZeros));
  };
  int carry = 0;
  const char* from = b.end;
  for (char* to = a.end; from > b.first() || carry != 0;) {
    to -= 8;
    const std::int64_t summand = from > b.first() ? eight_at(from -= 8) : 0;
    const std::int64_t sum = eight_at(to) + sign * summand + carry;
    carry = sum >= kEightDigits ? 1 : sum < 0 ? -1 : 0;
    store_eight(to, split_digits(static_cast<std::uint32_t>(sum - carry * kEightDigits)) + kEightZeros);
  }
}

/// Rounds the digits before `cut` to nearest, ties to even, by those from `cut` to `end`.
void round_at(char* cut, char* end) {
  const bool is_above_tie = std::any_of(cut + 1, end, [](char c) { return c != '0'; });
  const bool is_odd = (cut[-1] - '0') % 2 != 0;
  if (*cut < '5' || (*cut == '5' && !is_above_tie && !is_odd)) return;
  char* digit = cut - 1;
  for (; *digit == '9'; --digit) *digit = '0';
  ++*digit;
}

}  // namespace

char* print_exact_sum(char* out, double hi, double lo, int decimals) {
  // At least one decimal more than requested, to round by.
  const int exact = std::max({exact_decimals(hi), exact_decimals(lo), decimals + 1});
  ExactDigits sum(hi, exact);
  ExactDigits low(lo, exact);
  add(sum, low, std::signbit(hi) == std::signbit(lo) ? 1 : -1);
  char* const point = sum.end - exact;
  round_at(point + decimals, sum.end);
  const char* first = sum.characters.data();
  while (*first == '0' && first + 1 < point) ++first;
  if (std::signbit(hi)) *out++ = '-';
  out = std::copy(first, static_cast<const char*>(point), out);
  if (decimals > 0) *out++ = '.';
  return std::copy_n(point, decimals, out);
}

}  // namespace pipeline
