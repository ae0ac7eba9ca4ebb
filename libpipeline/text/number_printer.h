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

constexpr NumberFormat kShortest = {.shortest = true};

constexpr int kMaxDecimals = 17;

/// The maximum length of a printed number: a sign, 309 digits, a point and the decimals.
constexpr std::size_t kMaxNumberLength = 1 + 309 + 1 + kMaxDecimals;

/// Prints the nearest decimal to hi + lo, ties to even, in the form of `format`, and returns the end of the
/// text. Zero has no sign and is always "0.000..." or "0". Both parts must be finite, |lo| <= ulp(hi) / 2;
/// the shortest form uses hi alone. `out` must have room for kMaxNumberLength characters.
char* print_number(char* out, double hi, double lo, NumberFormat format);

/// The same in the shortest form.
char* print_shortest(char* out, double value);

/// The shortest text that reads back to `value`, which must be finite.
std::string shortest_text(double value);

}  // namespace pipeline
