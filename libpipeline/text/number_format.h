#pragma once

namespace pipeline {

/// How coordinates are printed: with a fixed number of decimals, or shortest (reads back to the same double).
struct NumberFormat {
  int decimals = 7;
  bool shortest = false;
};

constexpr int kMaxDecimals = 17;

}  // namespace pipeline
