#pragma once

namespace pipeline {

// The fast path for decimal numbers without an exponent that are not in the fixed form (fixed_text.h), as
// people, other programs and `--digits` write them. Everything else is left to parse_number.

/// A number written as [-] digits [. digits].
struct DecimalNumber {
  double value = 0;  // the nearest double, as parse_number returns it
  int decimals = 0;  // the count of digits after the point
};

/// At least this many readable characters must follow the text, whatever they are.
constexpr int kDecimalNumberSlack = 64;

/// Reads the number at `p` and returns its end. Null if there is none, or one that only the general reader
/// can read: with a '+', with more than 8 digits before the point, with more digits than 64 bits hold, or so
/// close to the midpoint of two doubles that rounding it needs multiprecision arithmetic. The character after
/// the number is not checked.
const char* read_decimal_number(const char* p, DecimalNumber& number);

}  // namespace pipeline
