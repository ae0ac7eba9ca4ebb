#pragma once

#include <cstddef>
#include <string>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// The form of printed coordinates: a fixed count of decimals, or the shortest text that reads back to the
/// same double.
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

/// Prints `value` in the shortest form.
char* print_shortest(char* out, double value);
/// Prints the shortest text that reads back to the same float; 0 has no sign. `out` must have room for
/// kMaxFloatLength characters.
constexpr std::size_t kMaxFloatLength = 24;
char* print_shortest_float(char* out, float value);

/// Prints three numbers with a blank after each; `low_part` is added, but not in the shortest form.
inline char* print_three(char* out, const Vec3& numbers, const Vec3& low_part, NumberFormat format) {
  const auto print = [&](double hi, double lo) {
    out = format.shortest ? print_shortest(out, hi) : print_number(out, hi, lo, format);
    *out++ = ' ';
  };
  print(numbers.x, low_part.x);
  print(numbers.y, low_part.y);
  print(numbers.z, low_part.z);
  return out;
}

/// The shortest text that reads back to `value`, which must be finite.
std::string shortest_text(double value);

/// Prints hi + lo, the exact sum, with `decimals` digits after the point, correctly rounded, ties to even,
/// and returns the end of the text; zero has no sign. It is for numbers that no double can hold
/// (10000000000000000.1): both parts are printed exactly and added digit by digit. Both must be finite,
/// |lo| <= |hi|.
char* print_exact_sum(char* out, double hi, double lo, int decimals);

}  // namespace pipeline
