#include "libpipeline/text/fixed_depths.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace pipeline {
namespace {

constexpr std::uint32_t kUnitsPerOne = 1'000'000;

struct DigitTriples {
  std::array<char, 4000> characters{};
  constexpr DigitTriples() {
    for (std::size_t i = 0; i < 1000; ++i) {
      characters[4 * i] = static_cast<char>('0' + i / 100);
      characters[4 * i + 1] = static_cast<char>('0' + i / 10 % 10);
      characters[4 * i + 2] = static_cast<char>('0' + i % 10);
      characters[4 * i + 3] = '\t';  // after the last three, what belongs there
    }
  }
};

constexpr DigitTriples kDigitTriples;

/// Three digits, and a fourth character to be written over or kept.
char* write_triple(char* out, std::uint32_t triple) {
  std::memcpy(out, kDigitTriples.characters.data() + std::size_t{4} * triple, 4);
  return out + 3;
}

char* write_whole(char* out, std::uint32_t whole) {
  std::array<char, 9> digits;
  std::size_t first = digits.size();
  for (; whole >= 10; whole /= 10) digits[--first] = static_cast<char>('0' + whole % 10);
  digits[--first] = static_cast<char>('0' + whole);
  std::memcpy(out, &digits[first], digits.size() - first);
  return out + (digits.size() - first);
}

/// Null where the depth is too large, not finite, or too near to a tie.
char* write_depth(char* out, double depth) {
  constexpr double kRounder = 0x1.8p52;
  const double scaled = std::fabs(depth) * kUnitsPerOne;
  if (!(scaled < 9e14)) return nullptr;
  const double units = (scaled + kRounder) - kRounder;
  // The product is rounded: by at most 2^-53 of itself.
  if (std::fabs(scaled - units) + scaled * 0x1p-52 >= 0.5) return nullptr;
  const auto whole_units = static_cast<std::uint64_t>(units);
  *out = '-';
  out += static_cast<int>(depth < 0) & static_cast<int>(whole_units != 0);
  std::uint32_t decimals = static_cast<std::uint32_t>(whole_units);
  if (whole_units < std::uint64_t{10} * kUnitsPerOne) {
    const std::uint32_t whole = decimals / kUnitsPerOne;
    *out++ = static_cast<char>('0' + whole);
    decimals -= whole * kUnitsPerOne;
  } else {
    out = write_whole(out, static_cast<std::uint32_t>(whole_units / kUnitsPerOne));
    decimals = static_cast<std::uint32_t>(whole_units % kUnitsPerOne);
  }
  *out++ = '.';
  return write_triple(write_triple(out, decimals / 1000), decimals % 1000) + 1;
}

}  // namespace

FixedDepths write_fixed_depths(std::span<const double> depths, double rear, char* out) {
  FixedDepths written = {0, out};
  for (const double depth : depths) {
    if (depth < rear) {
      char* const next = write_depth(written.end, depth);
      if (next == nullptr) break;
      written.end = next;
    }
    ++written.count;
  }
  return written;
}

}  // namespace pipeline
