#pragma once

namespace pipeline {

/// Prints hi + lo, the exact sum, with `decimals` digits after the point, correctly rounded, ties to even,
/// and returns the end of the text. It serves the numbers a double has no room for (10000000000000000.1) and
/// is not fast: long arithmetic over all bits of both parts. Both must be finite.
char* print_exact_sum(char* out, double hi, double lo, int decimals);

}  // namespace pipeline
