// The number parser against the C library's, and its exact decimals against rational arithmetic.

#include <gmpxx.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <string>

#include "libpipeline/text/number_parser.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/require.h"

namespace pipeline {
namespace {

std::size_t skip_digits(const std::string& word, std::size_t from) {
  return std::min(word.find_first_not_of("0123456789", from), word.size());
}

/// [+-] digits [. digits] [e [+-] digits], with at least one digit before the exponent.
bool is_decimal_number(const std::string& word) {
  const auto is_sign = [&](std::size_t at) {
    return at < word.size() && (word[at] == '+' || word[at] == '-');
  };
  std::size_t at = is_sign(0) ? 1 : 0;
  std::size_t end = skip_digits(word, at);
  std::size_t digit_count = end - at;
  if (end < word.size() && word[end] == '.') {
    at = end + 1;
    end = skip_digits(word, at);
    digit_count += end - at;
  }
  if (digit_count == 0) return false;
  if (end == word.size()) return true;
  if (word[end] != 'e' && word[end] != 'E') return false;
  at = end + 1;
  if (is_sign(at)) ++at;
  return at < word.size() && skip_digits(word, at) == word.size();
}

/// A decimal number without an exponent.
mpq_class rational(const std::string& word) {
  std::string digits;
  std::size_t decimals = 0;
  const std::size_t point = word.find('.');
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (word[i] < '0' || word[i] > '9') continue;
    digits += word[i];
    if (point != std::string::npos && i > point) ++decimals;
  }
  mpz_class power;
  mpz_ui_pow_ui(power.get_mpz_t(), 10, decimals);
  mpq_class value(mpz_class(digits, 10), power);
  value.canonicalize();
  return word.front() == '-' ? mpq_class(-value) : value;
}

void check_value(const std::string& word) {
  const ParsedNumber parsed = parse_number(word);
  if (!is_decimal_number(word)) {
    require(parsed.error == NumberError::not_a_number, "what is no decimal number is refused");
    return;
  }
  const double nearest = std::strtod(word.c_str(), nullptr);
  if (std::isinf(nearest)) {
    require(parsed.error == NumberError::overflow, "what is beyond a double overflows");
    return;
  }
  require(parsed.error == NumberError::none, "a decimal number is accepted");
  require(std::bit_cast<std::uint64_t>(parsed.value) == std::bit_cast<std::uint64_t>(nearest),
          "it is the nearest double");
}

void check_exact_decimal(const std::string& word) {
  DoubleDouble value;
  if (parse_number(word).error != NumberError::none || !parse_exact_decimal(word, value)) return;
  require(value.hi == parse_number(word).value, "the high part is the nearest double");
  if (std::fabs(value.hi) < 9e8) {
    require(value.lo == 0, "a small decimal is known by its double");
    return;
  }
  const mpq_class error = abs(mpq_class(value.hi) + mpq_class(value.lo) - rational(word));
  require(error <= abs(rational(word)) * mpq_class(0x1p-98), "a decimal is within 2^-98 of itself");
}

}  // namespace

void check(FuzzBytes bytes) {
  const std::string word(bytes.rest());
  // strtod would stop at a NUL in a word; the parser has to refuse it.
  if (word.find('\0') != std::string::npos)
    return require(parse_number(word).error == NumberError::not_a_number, "NUL is no digit");
  check_value(word);
  check_exact_decimal(word);
}

}  // namespace pipeline
