#include "libpipeline/text/wide_decimal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace pipeline {
namespace {

constexpr int kMaxExactDecimals = 1074;  // 2^-1074 has this many

/// Enough decimals to write a number exactly: its last bit is worth 2^(ilogb - 52) or more, and 2^-n has n
/// decimals.
int exact_decimals(double value) {
  return value == 0 ? 0 : std::clamp(52 - std::ilogb(value), 0, kMaxExactDecimals);
}

/// The exact digits of a number's absolute value, without the point; a zero precedes them.
struct ExactDigits {
  std::array<char, 1 + 309 + 1 + kMaxExactDecimals> characters;
  char* end;

  /// `decimals` is at least 1 and makes the number exact.
  ExactDigits(double value, int decimals) {
    characters[0] = '0';
    char* const limit = characters.data() + characters.size();
    end =
        std::to_chars(characters.data() + 1, limit, std::fabs(value), std::chars_format::fixed, decimals).ptr;
    end = std::copy(end - decimals, end, end - decimals - 1);
  }
};

/// a = |a + sign * b|, where both have the same count of decimals and b is not the larger one.
void add(ExactDigits& a, const ExactDigits& b, int sign) {
  int carry = 0;
  const char* from = b.end;
  for (char* to = a.end; from > b.characters.data() || carry != 0;) {
    const int digit = from > b.characters.data() ? *--from - '0' : 0;
    const int sum = (*--to - '0') + sign * digit + carry;
    carry = sum > 9 ? 1 : sum < 0 ? -1 : 0;
    *to = static_cast<char>('0' + sum - 10 * carry);
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
  if (lo != 0) add(sum, ExactDigits(lo, exact), std::signbit(hi) == std::signbit(lo) ? 1 : -1);
  char* const point = sum.end - exact;
  round_at(point + decimals, sum.end);
  const char* first = sum.characters.data();
  while (*first == '0' && first + 1 < point) ++first;
  const char* const end = point + decimals;
  if (std::signbit(hi) && std::any_of(first, end, [](char c) { return c != '0'; })) *out++ = '-';
  out = std::copy(first, static_cast<const char*>(point), out);
  if (decimals > 0) *out++ = '.';
  return std::copy_n(point, decimals, out);
}

}  // namespace pipeline
