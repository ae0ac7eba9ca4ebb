// The number printer against the C library's and rational arithmetic.

#include <gmpxx.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "libpipeline/numbers/decimal_units.h"
#include "libpipeline/text/number_printer.h"
#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/require.h"

namespace pipeline {
namespace {

std::string printed(double hi, double lo, NumberFormat format) {
  char text[kMaxNumberLength];
  return {text, print_number(text, hi, lo, format)};
}

/// The text without the sign of a zero.
std::string without_sign_of_zero(const std::string& text) {
  return text.find_first_of("123456789") == std::string::npos && text.front() == '-' ? text.substr(1) : text;
}

/// The output of glibc, which rounds exactly, ties to even.
std::string reference(double value, int decimals) {
  char text[kMaxNumberLength + 1];
  return {text, static_cast<std::size_t>(std::snprintf(text, sizeof text, "%.*f", decimals, value))};
}

/// The nearest decimal to a sum, ties to even.
std::string reference(double hi, double lo, int decimals) {
  mpz_class scale;
  mpz_ui_pow_ui(scale.get_mpz_t(), 10, static_cast<unsigned long>(decimals));
  const mpq_class value = abs(mpq_class(hi) + mpq_class(lo)) * scale;
  const mpz_class floor = value.get_num() / value.get_den();
  const mpq_class rest = value - floor;
  const mpq_class half(1, 2);
  const bool is_up = rest > half || (rest == half && floor % 2 != 0);
  std::string digits = mpz_class(floor + (is_up ? 1 : 0)).get_str();
  const auto decimal_count = static_cast<std::size_t>(decimals);
  if (digits.size() <= decimal_count) digits.insert(0, decimal_count + 1 - digits.size(), '0');
  if (decimals > 0) digits.insert(digits.size() - decimal_count, ".");
  const bool is_negative = hi < 0 || (hi == 0 && lo < 0);
  return without_sign_of_zero((is_negative ? "-" : "") + digits);
}

void check_shortest(double value) {
  const std::string text = printed(value, 0, {.decimals = 7, .shortest = true});
  require(std::strtod(text.c_str(), nullptr) == value, "a shortest number reads back");
  char exact[64];
  std::snprintf(exact, sizeof exact, "%.17g", value);
  require(text.size() <= std::max(std::string(exact).size(), std::size_t{22}), "it is short");
  require(text.front() != '-' || value < 0, "zero has no sign");
}

void check_safety(double value, double error, NumberFormat format) {
  const double scale = kPowersOfTen[static_cast<std::size_t>(format.decimals)];
  if (!DecimalUnits(value, scale).is_certain(error * scale)) return;
  const std::string text = printed(value, 0, format);
  require(text == without_sign_of_zero(reference(value - error, format.decimals)),
          "a safe number may be smaller");
  require(text == without_sign_of_zero(reference(value + error, format.decimals)),
          "a safe number may be larger");
}

}  // namespace

void check(FuzzBytes bytes) {
  const NumberFormat format = {.decimals = bytes.whole(kMaxDecimals), .shortest = false};
  const double hi = bytes.number();
  require(printed(hi, 0, format) == without_sign_of_zero(reference(hi, format.decimals)),
          "doubles are printed right");
  check_shortest(hi);
  // A low part below half of the last place of hi, as PrintableNumber promises.
  const double ulp = std::nextafter(std::fabs(hi), HUGE_VAL) - std::fabs(hi);
  const double lo = std::isfinite(ulp) ? ulp / 2 * ((bytes.byte() - 128) / 128.0) : 0;
  if (std::isfinite(hi + lo))
    require(printed(hi, lo, format) == reference(hi, lo, format.decimals), "sums are, too");
  check_safety(hi, std::ldexp(1.0, -bytes.whole(120)), format);
}

}  // namespace pipeline
