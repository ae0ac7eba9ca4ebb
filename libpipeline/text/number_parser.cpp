#include "libpipeline/text/number_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/text/eight_digits.h"

namespace pipeline {
namespace {

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000

/// Stands in for std::from_chars of a double, which libc++ lacks before 20, by strtod; for words that begin
/// with a digit, a point or a minus. A number too small for a double becomes 0. strtod rounds to nearest, and
/// no code here sets a locale other than "C".
std::from_chars_result double_from_chars(const char* first, const char* last, double& value) {
  // Restricts what strtod accepts: no "0x10" and no "-inf".
  const std::string word(first, std::find_if(first, last, [](char c) {
                           return !is_digit(c) && std::string_view("+-.eE").find(c) == std::string_view::npos;
                         }));
  char* end = nullptr;
  value = std::strtod(word.c_str(), &end);
  const char* const stop = first + (end - word.c_str());
  if (stop == first) return {first, std::errc::invalid_argument};
  return {stop, std::isinf(value) ? std::errc::result_out_of_range : std::errc()};
}

#else

std::from_chars_result double_from_chars(const char* first, const char* last, double& value) {
  return std::from_chars(first, last, value);
}

#endif

/// The decimal exponent of the first nonzero digit of a word that from_chars has accepted.
long long leading_exponent(std::string_view word) {
  const std::size_t e = word.find_first_of("eE");
  const std::string_view mantissa = word.substr(0, e);
  long long exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = word.substr(e + 1);
    if (digits.front() == '+') digits.remove_prefix(1);
    // Far beyond any double's exponent, and no overflow when the count of digits on a line is added.
    constexpr long long kMaxExponent = 1'000'000'000'000;
    const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    if (result.ec != std::errc()) exponent = digits.front() == '-' ? -kMaxExponent : kMaxExponent;
    exponent = std::clamp(exponent, -kMaxExponent, kMaxExponent);
  }
  const std::size_t point = std::min(mantissa.find('.'), mantissa.size());
  const std::size_t leading = mantissa.find_first_of("123456789");
  if (leading == std::string_view::npos) return exponent;
  return exponent + static_cast<long long>(point) - static_cast<long long>(leading);
}

}  // namespace

// S3
ParsedNumber parse_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') {
    word.remove_prefix(1);
    if (!word.empty() && word.front() == '-') return {0, NumberError::not_a_number};
  }
  const std::string_view unsigned_word = !word.empty() && word.front() == '-' ? word.substr(1) : word;
  // from_chars also accepts "inf", "nan" and ".5"; only the last is a number here.
  if (unsigned_word.empty() || (!is_digit(unsigned_word.front()) && unsigned_word.front() != '.'))
    return {0, NumberError::not_a_number};
  ParsedNumber parsed;
  const char* const end = word.data() + word.size();
  const auto [stop, code] = double_from_chars(word.data(), end, parsed.value);
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
  // Below 2^53 units of 10^-7, at most one such decimal rounds to a given double.
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

// S4
bool parse_count(std::string_view word, std::uint64_t& value, int base) {
  const auto [stop, code] = std::from_chars(word.data(), word.data() + word.size(), value, base);
  return !word.empty() && code == std::errc() && stop == word.data() + word.size();
}

}  // namespace pipeline
