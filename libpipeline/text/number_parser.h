#pragma once

#include <cstddef>
#include <string_view>

#include "libpipeline/numbers/double_double.h"

namespace pipeline {

enum class NumberError { none, not_a_number, overflow };

struct ParsedNumber {
  double value = 0;
  NumberError error = NumberError::none;
};

/// The nearest double to a whole word of decimal text: [+-] digits [. digits] [e [+-] digits], with at least
/// one digit before the exponent. What is too small for a double is 0 of either sign. `nan`, `inf`,
/// hexadecimal, a comma and trailing characters are not numbers. The locale has no influence.
ParsedNumber parse_number(std::string_view word);

/// The most decimals a number may have to be taken as that decimal by an exact calculation.
constexpr int kExactDecimals = 7;

/// What an exact calculation makes of a word that parse_number accepts: a plain number (no exponent) below
/// 10^22 with at most kExactDecimals decimals is that decimal, given as hi + lo within 2^-98 of itself; false
/// for any other, which is its nearest double. hi is what parse_number gives.
bool parse_exact_decimal(std::string_view word, DoubleDouble& value);

/// A whole word of decimal digits; false where it is anything else or does not fit.
bool parse_count(std::string_view word, std::size_t& value);

}  // namespace pipeline
