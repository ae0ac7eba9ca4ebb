#include "libpipeline/text/fixed_depths.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

#include "libpipeline/numbers/decimal_units.h"

namespace pipeline {
namespace {

// A number is scaled to a whole number of units of the last decimal, and its digits are looked up in a table
// of all groups of three digits.

struct DigitTriples {
  std::array<char, 4000> characters{};
  constexpr DigitTriples() {
    for (std::size_t i = 0; i < 1000; ++i) {
      characters[4 * i] = static_cast<char>('0' + i / 100);
      characters[4 * i + 1] = static_cast<char>('0' + i / 10 % 10);
      characters[4 * i + 2] = static_cast<char>('0' + i % 10);
    }
  }
};

constexpr DigitTriples kDigitTriples;

/// Writes three digits, and a fourth character for the caller to overwrite.
char* write_triple(char* out, std::uint32_t triple) {
  std::memcpy(out, kDigitTriples.characters.data() + std::size_t{4} * triple, 4);
  return out + 3;
}

/// Prints a number with six decimals, ties excluded, and returns the end of its text; the character after it
/// is overwritten, too. Null where the number has 10^15 units of the last decimal or more, is not finite, or
/// lies so close to a tie that only exact arithmetic can round it. A number that rounds to zero carries no
/// sign.
char* write_number(char* out, double value) {
  constexpr std::uint32_t kScale = 1'000'000;
  const DecimalUnits rounded(value, kScale);
  if (!(rounded.whole < 1e15) || !rounded.is_certain()) return nullptr;
  const auto units = static_cast<std::uint64_t>(rounded.whole);
  *out = '-';
  out += static_cast<int>(value < 0) & static_cast<int>(units != 0);
  auto behind_point = static_cast<std::uint32_t>(units);
  if (units < std::uint64_t{10} * kScale) {
    const std::uint32_t whole = behind_point / kScale;
    *out++ = static_cast<char>('0' + whole);
    behind_point -= whole * kScale;
  } else {
    out = std::to_chars(out, out + 9, units / kScale).ptr;
    behind_point = static_cast<std::uint32_t>(units % kScale);
  }
  *out++ = '.';
  return write_triple(write_triple(out, behind_point / 1000), behind_point % 1000);
}

}  // namespace

FixedDepths write_fixed_depths(std::span<const double> depths, double rear, char* out) {
  FixedDepths written = {0, out};
  for (const double depth : depths) {
    if (depth < rear) {
      char* const end = write_number(written.end, depth);
      if (end == nullptr) break;
      *end = '\t';
      written.end = end + 1;
    }
    ++written.count;
  }
  return written;
}

}  // namespace pipeline
