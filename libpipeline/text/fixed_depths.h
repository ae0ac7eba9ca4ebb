#pragma once

#include <cstddef>
#include <span>

namespace pipeline {

// The fast path of z-buffer text: depths of up to nine digits before the point, six decimals and a tab,
// printed as scaled whole numbers. All other depths are left to the general printer; the bytes are
// the same.

/// The most characters one depth takes: a sign, nine digits, a point, six decimals, a tab.
constexpr std::size_t kMaxFixedDepthLength = 1 + 9 + 1 + 6 + 1;

/// How many depths were printed, and where their text ends.
struct FixedDepths {
  std::size_t count = 0;  // of depths, including those at the rear
  char* end = nullptr;    // of the text
};

/// Prints the depths below `rear`, each rounded to six decimals, and skips the others. Stops before a depth
/// that is too large, or so close to a tie that only exact arithmetic can round it. `out` has room for
/// kMaxFixedDepthLength each.
FixedDepths write_fixed_depths(std::span<const double> depths, double rear, char* out);

}  // namespace pipeline
