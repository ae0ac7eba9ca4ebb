#pragma once

#include <cstdint>
#include <string_view>

#include "libpipeline/numbers/double_double.h"

namespace pipeline {

enum class NumberError { none, not_a_number, overflow };

struct ParsedNumber {
  double value = 0;
  NumberError error = NumberError::none;
};

/// True if a word begins like a number; only parsing it shows whether it is one.
inline bool begins_like_number(std::string_view word) {
  return word.find_first_of("+-.0123456789") == 0;
}

/// Parses a whole word of decimal text, [+-] digits [. digits] [e [+-] digits] with at least one digit before
/// the exponent, as the nearest double. Numbers too small for a double become a zero of the same sign. `nan`,
/// `inf`, hexadecimal, a comma and trailing characters are errors. The locale has no influence.
ParsedNumber parse_number(std::string_view word);

/// In exact arithmetic, a number with at most this many decimals stands for exactly that decimal.
constexpr int kExactDecimals = 7;

/// The value that exact arithmetic uses for a word that parse_number accepts. A number below 10^22, without
/// an exponent and with at most kExactDecimals decimals, stands for exactly that decimal: hi + lo, with a
/// relative error of at most 2^-98, where hi is the double that parse_number returns. False for any other
/// number, which stands for its nearest double.
bool parse_exact_decimal(std::string_view word, DoubleDouble& value);

/// Parses a whole word of digits, decimal unless there is another base; false for anything else or a number
/// that does not fit.
bool parse_count(std::string_view word, std::uint64_t& value, int base = 10);

// The fast path for decimal numbers without an exponent that are not in the fixed form (fixed_text.h), as
// people, other programs and `--digits` write them. Everything else is left to parse_number.

/// A number written as [-] digits [. digits].
struct DecimalNumber {
  double value = 0;  // the nearest double, as parse_number returns it
  int decimals = 0;  // the count of digits after the point
};

/// At least this many readable characters must follow the text; their values do not matter.
constexpr int kDecimalNumberSlack = 64;

/// Reads the number at `p` and returns its end. Null if there is none, or one that only the general reader
/// can read: with a '+', with more than 8 digits before the point, with more digits than fit in 64 bits, or
/// so close to the midpoint of two doubles that rounding it needs multiprecision arithmetic. The character
/// after the number is not checked.
const char* read_decimal_number(const char* p, DecimalNumber& number);

}  // namespace pipeline
