#pragma once

#include <cstddef>
#include <string>

namespace pipeline {

/// How coordinates are printed: with a fixed count of decimals, or in the shortest form that reads back to
/// the same double.
struct NumberFormat {
  int decimals = 7;
  bool shortest = false;
};

constexpr int kMaxDecimals = 17;

/// The most characters `print_number` writes: a sign, 309 digits, a point and the decimals.
constexpr std::size_t kMaxNumberLength = 1 + 309 + 1 + kMaxDecimals;

/// Prints the nearest decimal to hi + lo, ties to even, in the form `format` asks for, and returns the end of
/// the text. Zero is printed without a sign, and never in another form than "0.000..." or "0". Both parts
/// must be finite, |lo| <= ulp(hi) / 2; a shortest number is made of hi alone. `out` has room for
/// kMaxNumberLength.
char* print_number(char* out, double hi, double lo, NumberFormat format);

/// The shortest text that reads back to `value`, which must be finite.
std::string shortest_text(double value);

}  // namespace pipeline
