#pragma once

#include <span>

namespace pipeline {

// The fast path of numbers that are written without an exponent but not in the fixed form (fixed_text.h):
// what people and other programs write, and `--digits`. Whatever else stands in a text is left to
// parse_number.

/// A number as it was written: [-] digits [. digits].
struct DecimalNumber {
  double value = 0;  // the nearest double, as parse_number gives it
  int decimals = 0;  // how many digits stood behind the point
};

/// The text has to be followed by this many characters that may be looked at and mean nothing.
constexpr int kDecimalNumberSlack = 64;

/// Reads the number at `p` and returns its end. Null if none stands there, or one that the general reader has
/// to take: with a '+', with more than 8 digits before the point, with more digits than 64 bits hold, or so
/// near to the middle between two doubles that it takes long arithmetic to tell. What follows the number is
/// not looked at.
const char* read_decimal_number(const char* p, DecimalNumber& number);

/// Reads a line that holds these plain numbers and blanks and nothing else, and returns the beginning of the
/// next. Null if the line is another, or does not end before `end`.
const char* read_decimal_line(const char* p, const char* end, std::span<DecimalNumber> numbers);

}  // namespace pipeline
