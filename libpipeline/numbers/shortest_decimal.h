#pragma once

#include <cstdint>

namespace pipeline {

/// digits * 10^exponent.
struct Decimal {
  std::uint64_t digits = 0;  // at most 17 of them
  int exponent = 0;
};

/// Finds the shortest decimal that reads back to `value`, the nearest if there are several, as to_chars
/// prints it; it may have trailing zeros. By Schubfach (R. Giulietti, "The Schubfach way to render doubles",
/// 2020), for values of usual coordinates: false unless 2^-40 <= value < 2^53.
bool shortest_decimal(double value, Decimal& decimal);

}  // namespace pipeline
