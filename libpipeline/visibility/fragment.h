#pragma once

#include <cstdint>
#include <string>

namespace pipeline {

/// A pixel of the screen; row 0 is at the top, column 0 on the left.
struct Pixel {
  int column = 0;
  int row = 0;

  friend bool operator==(const Pixel&, const Pixel&) = default;
};

/// The result of a fragment's depth test.
enum class DepthTestResult {
  kept,
  behind,        // the visible one is nearer
  equal,         // the visible one is as near and came earlier
  too_close,     // it is nearer than the visible one, but not by more than the depth epsilon
  before_front,  // nearer than the front limit
  beyond_rear    // not nearer than the rear limit
};

/// One triangle at one pixel.
struct Fragment {
  Pixel pixel;
  std::uint64_t triangle = 0;
  double depth = 0;  // NDC z, as the depth format stores it; outside the limits as it was calculated
  DepthTestResult result = DepthTestResult::kept;
  std::uint64_t winner = 0;  // the triangle it lost to, if it is behind, equal or too close

  friend bool operator==(const Fragment&, const Fragment&) = default;
};

/// "COLUMN,ROW: triangle N, depth Z: kept", or "lost, " and why; the depth reads back to the same double.
std::string to_text(const Fragment& fragment);

}  // namespace pipeline
