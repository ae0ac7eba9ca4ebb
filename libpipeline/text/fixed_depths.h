#pragma once

#include <cstddef>
#include <span>

namespace pipeline {

// The fast path for z-buffer text: depths of up to nine digits before the point, six decimals and a tab,
// printed as scaled whole numbers. All other depths are left to the general printer; both print the same
// bytes.

/// The maximum length of a printed depth: a sign, nine digits, a point, six decimals, a tab.
constexpr std::size_t kMaxFixedDepthLength = 1 + 9 + 1 + 6 + 1;

/// How many depths were processed, and where their text ends.
struct FixedDepths {
  std::size_t count = 0;  // of depths, including the skipped ones
  char* end = nullptr;    // of the text
};

/// Prints the depths below `rear`, each rounded to six decimals, and skips the others. Stops before a depth
/// that is too large, or so close to a tie that only exact arithmetic can round it. `out` must have room for
/// kMaxFixedDepthLength characters per depth.
FixedDepths write_fixed_depths(std::span<const double> depths, double rear, char* out);

}  // namespace pipeline
