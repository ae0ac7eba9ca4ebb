#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/fixed_text_kernels.h"

namespace pipeline {
namespace {

constexpr double kUnitsPerOne = 1e7;

// ---- reading ----

/// How many characters stand before the point, 9 or more if it is not among the first nine.
unsigned digits_before_point(const char* p) {
  unsigned count = 0;
  while (count < 9 && p[count] != '.') ++count;
  return count;
}

/// Reads one number and the separator behind it; null where the form differs.
const char* read_number(const char* p, char separator, double& value) {
  const bool is_negative = *p == '-';
  p += is_negative ? 1 : 0;
  const unsigned count = digits_before_point(p);
  if (count < 1 || count > 8 || p[count + 8] != separator) return nullptr;
  // Shifted so that the digits are the last of eight; what comes in is zeros.
  const std::uint64_t before = (load_eight(p) - kEightZeros) << (8 * (8 - count));
  const std::uint64_t behind = (load_eight(p + count + 1) - kEightZeros) << 8;
  if (no_digits(before) != 0 || no_digits(behind) != 0) return nullptr;
  const std::uint64_t units = join_digits(before) * 10'000'000 + join_digits(behind);
  // Below 2^53 the conversion is exact, so that the quotient is the nearest double to the decimal.
  value = static_cast<double>(units) / kUnitsPerOne;
  if (is_negative) value = -value;
  return p + count + 9;
}

template <TriangleFrame frame>
const char* read_triangle(const char* p, Triangle& triangle) {
  if ((p = vertex_lines<frame>(p)) == nullptr) return nullptr;
  for (Vec3& vertex : triangle) {
    if ((p = read_number(p, ' ', vertex.x)) == nullptr) return nullptr;
    if ((p = read_number(p, ' ', vertex.y)) == nullptr) return nullptr;
    if ((p = read_number(p, '\n', vertex.z)) == nullptr) return nullptr;
  }
  if constexpr (frame == TriangleFrame::scene) return p;
  return *p == '\n' ? p + 1 : nullptr;
}

template <TriangleFrame frame>
FixedTextPart read_fixed_text(std::string_view text, std::span<Triangle> triangles) {
  FixedTextPart part;
  const char* p = text.data();
  const char* const end = p + text.size();
  for (Triangle& triangle : triangles) {
    if (p >= end) break;
    const char* const next = read_triangle<frame>(p, triangle);
    if (next == nullptr || next > end) break;
    p = next;
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(p - text.data());
  return part;
}

// ---- printing ----

struct DigitPairs {
  std::array<char, 200> characters{};
  constexpr DigitPairs() {
    for (std::size_t i = 0; i < 100; ++i) {
      characters[2 * i] = static_cast<char>('0' + i / 10);
      characters[2 * i + 1] = static_cast<char>('0' + i % 10);
    }
  }
};

constexpr DigitPairs kDigitPairs;

char* write_pair(char* out, std::uint32_t pair) {
  std::memcpy(out, kDigitPairs.characters.data() + std::size_t{2} * pair, 2);
  return out + 2;
}

char* write_whole(char* out, std::uint32_t whole) {
  std::array<char, 8> digits;
  char* const last = digits.data() + digits.size();
  char* first = last;
  for (; whole >= 100; whole /= 100) {
    first -= 2;
    write_pair(first, whole % 100);
  }
  if (whole >= 10) {
    first -= 2;
    write_pair(first, whole);
  } else {
    *--first = static_cast<char>('0' + whole);
  }
  const auto length = static_cast<std::size_t>(last - first);
  std::memcpy(out, first, length);
  return out + length;
}

/// Null where the number is too large, not finite, or too near to a tie.
char* write_number(char* out, double value) {
  constexpr double kRounder = 0x1.8p52;
  const double scaled = std::fabs(value) * kUnitsPerOne;
  if (!(scaled < 1e15)) return nullptr;
  const double units = (scaled + kRounder) - kRounder;
  // The product is rounded: by at most 2^-53 of itself.
  if (std::fabs(scaled - units) + scaled * 0x1p-52 >= 0.5 || units >= 1e15) return nullptr;
  const auto whole_units = static_cast<std::uint64_t>(units);
  const auto decimals = static_cast<std::uint32_t>(whole_units % 10'000'000);
  if (value < 0 && whole_units != 0) *out++ = '-';
  out = write_whole(out, static_cast<std::uint32_t>(whole_units / 10'000'000));
  *out++ = '.';
  *out++ = static_cast<char>('0' + decimals / 1'000'000);
  out = write_pair(out, decimals / 10'000 % 100);
  out = write_pair(out, decimals / 100 % 100);
  return write_pair(out, decimals % 100);
}

char* write_triangle(char* out, const Triangle& triangle) {
  for (const Vec3& vertex : triangle) {
    if ((out = write_number(out, vertex.x)) == nullptr) return nullptr;
    *out++ = ' ';
    if ((out = write_number(out, vertex.y)) == nullptr) return nullptr;
    *out++ = ' ';
    if ((out = write_number(out, vertex.z)) == nullptr) return nullptr;
    *out++ = '\n';
  }
  *out++ = '\n';
  return out;
}

FixedTextPart write_fixed_text(std::span<const Triangle> triangles, char* out) {
  FixedTextPart part;
  char* const begin = out;
  for (const Triangle& triangle : triangles) {
    char* const next = write_triangle(out, triangle);
    if (next == nullptr) break;
    out = next;
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(out - begin);
  return part;
}

}  // namespace

constinit const FixedTextKernel kPortableKernel = {"portable", read_fixed_text<TriangleFrame::stage_text>,
                                                   read_fixed_text<TriangleFrame::scene>, write_fixed_text};

}  // namespace pipeline
