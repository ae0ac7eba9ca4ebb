#include "libpipeline/number_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "libpipeline/eight_digits.h"
#include "libpipeline/int128.h"
#include "libpipeline/shortest_decimal.h"
#include "libpipeline/wide_decimal.h"

namespace pipeline {
namespace {

constexpr std::array<double, kMaxDecimals + 1> kPowersOfTen = {
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17};

constexpr auto kWholePowersOfTen = [] {
  std::array<std::uint64_t, 18> powers{};
  std::uint64_t power = 1;
  for (std::uint64_t& p : powers) {
    p = power;
    power *= 10;
  }
  return powers;
}();

// A ball narrower than this part of the last printed unit that reaches a tie counts as the tie.
constexpr double kTieTolerance = 0x1p-20;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// The whole number next to a number from 0 to 2^51, ties to even.
double nearest_whole(double value) {
  // Beyond 2^52 doubles are whole numbers.
  constexpr double kRounder = 0x1.8p52;
  return (value + kRounder) - kRounder;
}

/// The decimal exponent of the first digit that is not 0 in a word from_chars has accepted.
long long leading_exponent(std::string_view word) {
  const std::size_t e = word.find_first_of("eE");
  const std::string_view mantissa = word.substr(0, e);
  long long exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = word.substr(e + 1);
    if (digits.front() == '+') digits.remove_prefix(1);
    // Far beyond any double's; the digits of a line added to it are far from the end of 64 bits.
    constexpr long long kLargest = 1'000'000'000'000;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (result.ec != std::errc()) exponent = digits.front() == '-' ? -kLargest : kLargest;
    exponent = std::clamp(exponent, -kLargest, kLargest);
  }
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t leading = mantissa.find_first_of("123456789");
  if (leading == std::string_view::npos) return exponent;
  return exponent + static_cast<long long>(point) - static_cast<long long>(leading);
}

/// A number as the sum of a whole number and the exact rest, whose high part lies in [-1/2, 1/2].
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
  // Past 2^1000 the scaled number would overflow; none of its decimals is known there anyway.
  if (std::fabs(value.hi) > 0x1p900) return {value.hi, value.lo, false};
  const DoubleDouble scaled = value * scale;
  const double scaled_error = (error * scale + std::fabs(scaled.hi) * 0x1p-104) * (1 + 0x1p-40);
  auto [whole, rest] = split_at_whole(scaled);
  const double direction = std::copysign(1.0, rest.hi);
  // From the tie towards the whole number; exact where it is small.
  const double distance = (0.5 - std::fabs(rest.hi)) - direction * rest.lo;
  const bool may_be_tie = std::fabs(distance) <= scaled_error;
  const bool is_tie = may_be_tie && scaled_error <= kTieTolerance;
  if (is_tie ? is_odd(whole) : distance < 0) whole = whole + DoubleDouble{direction, 0};
  const bool is_certain = is_tie || !may_be_tie;
  const DoubleDouble decimal = whole / DoubleDouble{scale, 0};
  // A double that is nearer to the decimal than half a unit prints as that decimal by itself.
  if (std::fabs(whole.hi) < 0x1p51) return {decimal.hi, 0, is_certain};
  // A tie must be printed as the decimal chosen; other numbers are rounded right by the printing.
  return is_tie ? PrintableNumber{decimal.hi, decimal.lo} : PrintableNumber{value.hi, value.lo, is_certain};
}

PrintableNumber round_to_double(const Ball& ball) {
  const double nearest = ball.nearest_double();
  if (ball.is_exact()) return {nearest, 0};
  if (ball.sign() == 0) return {0, 0};
  // Distances are measured on the midpoint's own scale; past +-3000 they are infinite.
  const auto shift = static_cast<int>(std::clamp<std::int64_t>(-ball.exponent(), -3000, 3000));
  const auto [hi, lo] = ball.value();
  const double rest = hi - std::ldexp(nearest, shift);  // not 0 only below a double's normal range
  const double direction = std::copysign(1.0, rest != 0 ? rest : lo);
  const double neighbour = std::nextafter(nearest, direction * HUGE_VAL);
  const double half_gap = std::fabs(std::ldexp(neighbour, shift) - std::ldexp(nearest, shift)) / 2;
  const double distance = (half_gap - std::fabs(rest)) - direction * lo;
  if (distance > ball.error()) return {nearest, 0};
  if (ball.error() > 2 * half_gap * kTieTolerance) return {nearest, 0, false};
  const bool nearest_is_even = std::bit_cast<std::uint64_t>(nearest) % 2 == 0;
  return {nearest_is_even ? nearest : neighbour, 0};
}

/// Prints a number below 10^16 with at least `count` digits, zeros before; 16 characters may be written.
char* print_whole(char* out, std::uint64_t number, int count) {
  constexpr std::uint64_t kEightNines = 99'999'999;
  if (number <= kEightNines && count <= 8) {
    const std::uint64_t digits = split_digits(static_cast<std::uint32_t>(number));
    const int length = std::max(8 - std::countr_zero(digits | std::uint64_t{1} << 56) / 8, count);
    store_eight(out, (digits + kEightZeros) >> (8 * (8 - length)));
    return out + length;
  }
  const std::uint64_t high = number / (kEightNines + 1);
  const std::uint64_t first = split_digits(static_cast<std::uint32_t>(high));
  const std::uint64_t last = split_digits(static_cast<std::uint32_t>(number - high * (kEightNines + 1)));
  const int leading_zeros = (first != 0 ? std::countr_zero(first) : 64 + std::countr_zero(last)) / 8;
  const int length = std::max(16 - leading_zeros, count);
  // Shifted as one number: to store it and load it again from another place would take longer.
  UInt128 text = (static_cast<UInt128>(last + kEightZeros) << 64) | (first + kEightZeros);
  text >>= 8 * (16 - length);
  store_eight(out, static_cast<std::uint64_t>(text));
  store_eight(out + 8, static_cast<std::uint64_t>(text >> 64));
  return out + length;
}

/// The fast path of a fixed number of decimals: prints the scaled number as a whole one. Null where that has
/// more than 51 bits, or lies so near to a tie that the scaling may decide.
char* print_scaled(char* out, double value, int decimals) {
  const auto n = static_cast<std::size_t>(decimals);
  if (decimals > 15 || !rounds_safely(value, 0, {.decimals = decimals})) return nullptr;
  const auto units = static_cast<std::uint64_t>(nearest_whole(std::fabs(value) * kPowersOfTen[n]));
  if (value < 0 && units != 0) *out++ = '-';
  // Cut off instead of divided, which is right but for what was rounded up to a whole number.
  auto whole = static_cast<std::uint64_t>(std::fabs(value));
  std::uint64_t behind = units - whole * kWholePowersOfTen[n];
  if (behind >= kWholePowersOfTen[n]) {
    ++whole;
    behind -= kWholePowersOfTen[n];
  }
  out = print_whole(out, whole, 1);
  if (decimals == 0) return out;
  *out++ = '.';
  return print_whole(out, behind, decimals);
}

/// How many digits a number below 10^17 has.
int digit_count(std::uint64_t number) {
  // From log10(2), rounded up; one too many below a power of ten, which is then looked up.
  const auto count = static_cast<std::size_t>(std::bit_width(number) * 1233 >> 12);
  return static_cast<int>(count) + (number >= kWholePowersOfTen[count] ? 1 : 0);
}

/// The same for a number of up to 17 digits, with at least `count`.
char* print_long_whole(char* out, std::uint64_t number, int count) {
  constexpr std::uint64_t kSixteenZeros = 10'000'000'000'000'000;
  const std::uint64_t high = number / kSixteenZeros;
  if (high == 0 && count <= 16) return print_whole(out, number, count);
  out = print_whole(out, high, count - 16);
  return print_whole(out, number - high * kSixteenZeros, 16);
}

/// Prints in the shortest form that reads back to the number; null where that is one with an exponent, or the
/// number is not of a coordinate's size.
char* print_shortest(char* out, double value) {
  Decimal decimal;
  if (!shortest_decimal(std::fabs(value), decimal)) return nullptr;
  const auto& [digits, exponent] = decimal;
  // Written out, it must not be longer than with a point behind its first digit and "e+10".
  const int length = digit_count(digits);
  const int point_length = length > 1 ? 1 : 0;
  if (exponent > 4 + point_length || exponent < -(length + 2 + point_length)) return nullptr;
  if (value < 0) *out++ = '-';
  if (exponent >= 0)
    return print_long_whole(out, digits * kWholePowersOfTen[static_cast<std::size_t>(exponent)], 1);
  const auto decimals = static_cast<std::size_t>(-exponent);
  const std::uint64_t scale = decimals < kWholePowersOfTen.size() ? kWholePowersOfTen[decimals] : 0;
  // A decimal beyond the next whole number would not read back to this one.
  const auto whole = static_cast<std::uint64_t>(std::fabs(value));
  out = print_long_whole(out, whole, 1);
  *out++ = '.';
  return print_long_whole(out, digits - whole * scale, -exponent);
}

char* without_sign_of_zero(char* first, char* last) {
  if (*first != '-') return last;
  const bool is_zero = std::all_of(first + 1, last, [](char c) { return c == '0' || c == '.'; });
  if (!is_zero) return last;
  std::copy(first + 1, last, first);
  return last - 1;
}

}  // namespace

ParsedNumber parse_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') {
    word.remove_prefix(1);
    if (!word.empty() && word.front() == '-') return {0, NumberError::not_a_number};
  }
  const std::string_view unsigned_word = !word.empty() && word.front() == '-' ? word.substr(1) : word;
  // from_chars also takes "inf", "nan" and ".5"; the last is a number here as well.
  if (unsigned_word.empty() || (!is_digit(unsigned_word.front()) && unsigned_word.front() != '.'))
    return {0, NumberError::not_a_number};
  ParsedNumber parsed;
  const char* const end = word.data() + word.size();
  const auto [stop, code] = std::from_chars(word.data(), end, parsed.value);
  if (stop != end || code == std::errc::invalid_argument) return {0, NumberError::not_a_number};
  if (code == std::errc::result_out_of_range) {
    if (leading_exponent(unsigned_word) > 0) return {0, NumberError::overflow};
    parsed.value = word.front() == '-' ? -0.0 : 0.0;
  }
  return parsed;
}

bool parse_exact_decimal(std::string_view word, DoubleDouble& value) {
  if (word.find_first_of("eE") != std::string_view::npos) return false;
  const std::size_t point = std::min(word.find('.'), word.size());
  if (word.size() > point + 1 + kExactDecimals) return false;
  value = {parse_number(word).value, 0};
  // A whole number of 10^-7 below 2^53 is the only one near its double.
  if (std::fabs(value.hi) < 9e8) return true;
  if (std::fabs(value.hi) >= 1e22) return false;
  DoubleDouble units;
  int decimal_count = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (!is_digit(word[i])) continue;
    units = units * 10.0 + DoubleDouble{static_cast<double>(word[i] - '0'), 0};
    if (i > point) ++decimal_count;
  }
  const DoubleDouble decimal = units / DoubleDouble{kPowersOfTen[static_cast<std::size_t>(decimal_count)], 0};
  const double sign = word.front() == '-' ? -1 : 1;
  value.lo = (sign * decimal.hi - value.hi) + sign * decimal.lo;
  return true;
}

bool parse_count(std::string_view word, std::size_t& value) {
  const auto [stop, code] = std::from_chars(word.data(), word.data() + word.size(), value);
  return !word.empty() && code == std::errc() && stop == word.data() + word.size();
}

char* print_number(char* out, double hi, double lo, NumberFormat format) {
  assert(std::isfinite(hi) && std::isfinite(lo));
  if (format.shortest) {
    char* const end = print_shortest(out, hi);
    return end != nullptr ? end : std::to_chars(out, out + kMaxNumberLength, hi == 0 ? 0.0 : hi).ptr;
  }
  if (char* const end = lo == 0 ? print_scaled(out, hi, format.decimals) : nullptr) return end;
  char* const end =
      lo == 0 ? std::to_chars(out, out + kMaxNumberLength, hi, std::chars_format::fixed, format.decimals).ptr
              : print_exact_sum(out, hi, lo, format.decimals);
  return without_sign_of_zero(out, end);
}

PrintableNumber round_to_text(const Ball& ball, NumberFormat format) {
  const double nearest = ball.nearest_double();
  if (!std::isfinite(nearest)) return {nearest, 0, true};
  if (format.shortest) return round_to_double(ball);
  // What is below the range with an exponent of its own is far below half a unit of any decimals.
  if (ball.exponent() < 0) return {nearest, 0, true};
  if (ball.exponent() > 0) {
    const int shift = static_cast<int>(ball.exponent());
    const DoubleDouble value = {nearest, std::ldexp(ball.value().lo, shift)};
    return round_to_decimals(value, std::ldexp(ball.error(), shift), format.decimals);
  }
  return round_to_decimals(ball.value(), ball.error(), format.decimals);
}

bool rounds_safely(double value, double error, NumberFormat format) {
  if (format.shortest) return error == 0;
  const double scale = kPowersOfTen[static_cast<std::size_t>(format.decimals)];
  const double scaled = std::fabs(value) * scale;
  if (!(scaled < 0x1p51)) return false;
  // What the calculations here may lose.
  constexpr double kHalf = 0.5 - 0x1p-52;
  return std::fabs(scaled - nearest_whole(scaled)) + error * scale + scaled * 0x1p-52 < kHalf;
}

}  // namespace pipeline
