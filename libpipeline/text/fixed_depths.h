#pragma once

#include <cstddef>
#include <span>

namespace pipeline {

// The fast path of z-buffer text: depths of up to nine digits before the point, six decimals and a tab,
// printed as scaled whole numbers. Whatever differs is left to the general printer, and the bytes are the
// same.

/// The most characters one depth takes: a sign, nine digits, a point, six decimals, a tab.
constexpr std::size_t kMaxFixedDepthLength = 1 + 9 + 1 + 6 + 1;

/// How far depths were printed.
struct FixedDepths {
  std::size_t count = 0;  // of depths, those at the rear included
  char* end = nullptr;    // of their text
};

/// Prints the depths below `rear`, each rounded to the nearest six decimals, until there is one that is too
/// large, or so near to a tie that it takes exact arithmetic to round it. `out` has room for
/// kMaxFixedDepthLength each.
FixedDepths write_fixed_depths(std::span<const double> depths, double rear, char* out);

}  // namespace pipeline
