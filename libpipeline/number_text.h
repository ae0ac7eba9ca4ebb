#pragma once

#include <cstddef>
#include <string_view>

#include "libpipeline/ball.h"

namespace pipeline {

/// How coordinates are printed: with a fixed number of decimals, or shortest (reads back to the same double).
struct NumberFormat {
  int decimals = 7;
  bool shortest = false;
};

constexpr int kMaxDecimals = 17;

/// The most characters `print_number` writes: a sign, 309 digits, a point and the decimals.
constexpr std::size_t kMaxNumberLength = 1 + 309 + 1 + kMaxDecimals;

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

/// A coordinate ready to be printed: the exact sum hi + lo. `lo` is 0 unless a double cannot hold the
/// decimals that are asked for.
struct PrintableNumber {
  double hi = 0;
  double lo = 0;
  /// False where the ball was too wide to know every digit that will be printed.
  bool is_certain = true;
};

/// Prints the nearest decimal to hi + lo, ties to even, in the form `format` asks for, and returns the end of
/// the text. Zero is printed without a sign, and never in another form than "0.000..." or "0". Both parts
/// must be finite, |lo| <= ulp(hi) / 2; a shortest number is made of hi alone. `out` has room for
/// kMaxNumberLength.
char* print_number(char* out, double hi, double lo, NumberFormat format);

/// The number whose text is the correctly rounded text of every number in the ball; where the ball reaches a
/// point at which the rounding changes, and is narrower than 2^-20 of the last unit, it counts as that point
/// (ties to even). A ball around 0 that says no more than that is 0. Overflow gives an infinite hi.
PrintableNumber round_to_text(const Ball& ball, NumberFormat format);

/// True if every number within `error` of `value` has the text of `value` itself. The test may say false for
/// a number that is safe, never true for one that is not; infinities and NaN are not safe.
bool rounds_safely(double value, double error, NumberFormat format);

}  // namespace pipeline
