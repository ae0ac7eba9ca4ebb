#pragma once

#include <cstdint>

namespace pipeline {

/// digits * 10^exponent.
struct Decimal {
  std::uint64_t digits = 0;  // at most 17 of them
  int exponent = 0;
};

/// The shortest decimal that reads back to `value`, and the nearest of those, as to_chars prints it; zeros
/// may stand at its end. By Schubfach (R. Giulietti, "The Schubfach way to render doubles", 2020), for the
/// magnitudes of coordinates: false unless 2^-40 <= value < 2^53.
bool shortest_decimal(double value, Decimal& decimal);

}  // namespace pipeline
