#pragma once

#include <cstdint>

namespace pipeline {

/// digits * 10^exponent.
struct Decimal {
  std::uint64_t digits = 0;  // at most 17 of them
  int exponent = 0;
};

/// Finds the shortest decimal that reads back to `value`, the nearest if there are several, as to_chars
/// prints it; it may have trailing zeros. By one product, after Schubfach (R. Giulietti, "The Schubfach way
/// to render doubles", 2020). False for the few values that this cannot decide: powers of two, decimals next
/// to a tie or to an end of the interval, and all outside [2^-40, 2^53).
bool shortest_decimal(double value, Decimal& decimal);

}  // namespace pipeline
