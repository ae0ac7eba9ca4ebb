#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace pipeline {

// 128-bit integers, which GCC and Clang have on every 64-bit system under a name that is not standard C++.
__extension__ typedef __int128 Int128;
__extension__ typedef unsigned __int128 UInt128;

/// The count of bits without leading zeros; 0 for 0.
inline int bit_length(UInt128 value) {
  const auto high = static_cast<std::uint64_t>(value >> 64);
  const auto low = static_cast<std::uint64_t>(value);
  return (high != 0 ? 128 : 64) - std::countl_zero(high != 0 ? high : low);
}

/// 2^exponent, for a normal double.
inline double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + exponent) << 52);
}

/// The value as a double, with a relative error of at most 2^-53 + 2^-61: bits below the first 62 are cut
/// off. (The compiler's own conversion is a function call.)
inline double to_double(Int128 value) {
  const auto size = static_cast<UInt128>(value < 0 ? ~value : value);
  const int cut_off = std::max(bit_length(size) - 62, 0);
  return static_cast<double>(static_cast<std::int64_t>(value >> cut_off)) * power_of_two(cut_off);
}

}  // namespace pipeline
