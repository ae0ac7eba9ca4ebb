#pragma once

namespace pipeline {

/// Prints hi + lo, the exact sum, with `decimals` digits after the point, correctly rounded, ties to even,
/// and returns the end of the text; zero has no sign. It is for numbers that no double can hold
/// (10000000000000000.1): both parts are printed exactly and added digit by digit. Both must be finite,
/// |lo| <= |hi|.
char* print_exact_sum(char* out, double hi, double lo, int decimals);

}  // namespace pipeline
