#include "libpipeline/text/number_printer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/numbers/shortest_decimal.h"
#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/scaled_number.h"

namespace pipeline {
namespace {

/// The count of trailing zeros; 16 if all digits are 0.
int trailing_zero_count(SixteenDigits digits) {
  const int count = std::countl_zero(digits.last) / 8;
  return count < 8 ? count : 8 + std::countl_zero(digits.first) / 8;
}

/// Prints a number whose shortest decimal has digits after the point: at most 17, with zeros before them.
char* print_decimals(char* out, double value, const Decimal& decimal) {
  const auto decimals = static_cast<std::size_t>(-decimal.exponent);
  const std::uint64_t scale = decimals < kWholePowersOfTen.size() ? kWholePowersOfTen[decimals] : 0;
  out = print_sign(out, value < 0);
  // The decimal has the same whole part: beyond the next whole number it would not read back to this double.
  // It is below 10^17, so a signed conversion, which is shorter, will do.
  const auto whole = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::fabs(value)));
  out = print_before_point(out, whole);
  *out++ = '.';
  const std::uint64_t behind = decimal.digits - whole * scale;
  // The digits before the last sixteen come first: zeros and at most one other. Branch-free: whether there
  // are 16 or 17 is unpredictable.
  constexpr std::uint64_t kSixteenDigits = 10'000'000'000'000'000;
  const std::uint64_t high = behind / kSixteenDigits;
  const int high_count = std::max(-decimal.exponent - 16, 0), lacking = std::max(decimal.exponent + 16, 0);
  store_eight(out, kEightZeros + (high << (8 * high_count) >> 8));
  const SixteenDigits digits = split_sixteen(behind - high * kSixteenDigits);
  const char* const end = print_digits(out + high_count, digits, 16 - lacking);
  return out + (end - out) - trailing_zero_count(digits);
}

/// Prints a number from 0.001 to 10^5 that has at most seven decimals; null for any other. Its decimal has at
/// most twelve digits. No other decimal of at most 15 reads back to the same double, so this is the shortest.
char* print_few_decimals(char* out, double value) {
  constexpr std::uint64_t kScale = 10'000'000;
  const DecimalUnits units(value, kScale);
  if (units.whole / kScale != std::fabs(value)) return nullptr;
  const auto all = static_cast<std::uint64_t>(units.whole);
  const std::uint64_t whole = all / kScale;
  out = print_before_point(print_sign(out, value < 0), whole);
  *out = '.';
  const std::uint64_t digits = split_digits(static_cast<std::uint32_t>(all - whole * kScale)) >> 8;
  store_eight(out + 1, digits + kEightZeros);
  const int count = 8 - std::countl_zero(digits) / 8;
  return out + (count > 0 ? 1 + count : 0);
}

/// print_scaled for hi + lo, in units with at most 62 bits; null where there are more, or hi + lo may lie
/// within 2^-20 of a tie. Inlined, it made every number take longer.
[[gnu::noinline]] char* print_scaled_sum(char* out, double hi, double lo, int decimals) {
  const double scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  const double product = hi * scale;
  if (!(std::fabs(product) < 0x1p62)) return nullptr;
  const double whole_product = std::nearbyint(product);
  // The product's fraction and error are exact, the latter below 2^9, like lo * scale: rounded, they lose
  // 2^-41 at most.
  const double rest = (product - whole_product) + (std::fma(hi, scale, -product) + lo * scale);
  const double whole_rest = std::nearbyint(rest);
  if (!(std::fabs(rest - whole_rest) < 0.5 - 0x1p-20)) return nullptr;
  const auto units = static_cast<std::int64_t>(whole_product) + static_cast<std::int64_t>(whole_rest);
  return print_units(out, units < 0, static_cast<std::uint64_t>(std::abs(units)), decimals);
}

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

/// Rounds the digits before `cut` to nearest, ties to even, by the digits from `cut` to `end`.
void round_at(char* cut, char* end) {
  const bool is_above_tie = std::any_of(cut + 1, end, [](char c) { return c != '0'; });
  const bool is_odd = (cut[-1] - '0') % 2 != 0;
  if (*cut < '5' || (*cut == '5' && !is_above_tie && !is_odd)) return;
  char* digit = cut - 1;
  for (; *digit == '9'; --digit) *digit = '0';
  ++*digit;
}

}  // namespace

char* print_whole(char* out, std::uint64_t number) {
  constexpr std::uint64_t kEightDigits = 100'000'000;
  if (number < kEightDigits) {
    const std::uint64_t digits = split_digits(static_cast<std::uint32_t>(number));
    const int length = 8 - std::countr_zero(digits | std::uint64_t{1} << 56) / 8;
    store_eight(out, (digits + kEightZeros) >> (8 * (8 - length)));
    return out + length;
  }
  out = print_whole(out, number / kEightDigits);
  store_eight(out, split_digits(static_cast<std::uint32_t>(number % kEightDigits)) + kEightZeros);
  return out + 8;
}

char* print_shortest(char* out, double value) {
  Decimal decimal;
  const double size = std::fabs(value);
  if (size >= 0.001 && size < 1e5)
    if (char* const end = print_few_decimals(out, value)) return end;
  // Among these numbers, only whole ones may be shorter with an exponent.
  if (size >= 0.001 && (size < 1e5 || size != std::floor(size)) && shortest_decimal(size, decimal))
    return print_decimals(out, value, decimal);
  return std::to_chars(out, out + kMaxNumberLength, value == 0 ? 0.0 : value).ptr;
}

char* print_shortest_float(char* out, float value) {
  const double size = std::fabs(value);
  if (size >= 0x1p-9 && size < 0x1p12) {
    const std::uint64_t exponent = std::bit_cast<std::uint64_t>(size) >> 52;
    const double half_gap = std::bit_cast<double>(exponent << 52) * 0x1p-24;
    // Decimals with `fewest` digits after the point are farther apart than floats: at most one is near
    // enough, and no shorter one is. With two digits more they are closer together. The products are exact,
    // and no decimal lies on the border.
    const std::size_t fewest = 9 - (exponent - 1023 + 9) / 3;
    for (std::size_t decimals = fewest; decimals <= fewest + 2; ++decimals) {
      const double scale = kPowersOfTen[decimals], units = nearest_whole(size * scale);
      if (std::fabs(units - size * scale) < half_gap * scale)
        return print_shortest(out, std::copysign(units / scale, value));
    }
  }
  return std::to_chars(out, out + kMaxFloatLength, value == 0 ? 0.0F : value).ptr;
}

char* print_number(char* out, double hi, double lo, NumberFormat format) {
  assert(std::isfinite(hi) && std::isfinite(lo));
  if (format.shortest) return print_shortest(out, hi);
  if (format.decimals <= kMaxScaledDecimals) {
    if (char* const end = lo == 0 ? print_scaled(out, hi, format.decimals) : nullptr) return end;
    if (char* const end = print_scaled_sum(out, hi, lo, format.decimals)) return end;
  }
  return print_exact_sum(out, hi, lo, format.decimals);
}

std::string shortest_text(double value) {
  char text[kMaxNumberLength];
  return {text, print_number(text, value, 0, {.shortest = true})};
}

char* print_exact_sum(char* out, double hi, double lo, int decimals) {
  // At least one decimal more than requested, for rounding.
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
