#pragma once

#include <array>
#include <cstdint>

namespace pipeline {

/// 10^n for every n for which a double holds it exactly.
constexpr auto kPowersOfTen = [] {
  std::array<double, 23> powers{};
  double power = 1;
  for (double& p : powers) {
    p = power;
    power *= 10;
  }
  return powers;
}();

/// 10^n for every n for which it fits in 64 bits.
constexpr auto kWholePowersOfTen = [] {
  std::array<std::uint64_t, 20> powers{};
  std::uint64_t power = 1;
  for (std::uint64_t& p : powers) {
    p = power;
    power *= 10;
  }
  return powers;
}();

}  // namespace pipeline
