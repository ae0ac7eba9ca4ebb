#include <cstdint>

#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/fixed_number.h"
#include "libpipeline/text/fixed_text_kernels.h"

namespace pipeline {
namespace {

// ---- reading ----

/// Reads one number and the separator after it; null if the form differs.
const char* read_number(const char* p, char separator, double& value) {
  const bool is_negative = *p == '-';
  p += is_negative ? 1 : 0;
  const std::uint64_t before = load_eight(p) - kEightZeros;
  const std::size_t count = leading_digit_count(before);
  if (count == 0 || p[count] != '.' || p[count + 8] != separator) return nullptr;
  const std::uint64_t behind = (load_eight(p + count + 1) - kEightZeros) << 8;
  if (no_digits(behind) != 0) return nullptr;
  const std::uint64_t units = join_leading_digits(before, count) * 10'000'000 + join_digits(behind);
  // Below 2^53 the conversion is exact, so the quotient is the nearest double to the decimal.
  const double magnitude = static_cast<double>(units) / kUnitsPerOne;
  value = is_negative ? -magnitude : magnitude;
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

char* write_triangle(char* out, const Triangle& triangle) {
  for (const Vec3& vertex : triangle) {
    if ((out = write_fixed<7>(out, vertex.x)) == nullptr) return nullptr;
    *out++ = ' ';
    if ((out = write_fixed<7>(out, vertex.y)) == nullptr) return nullptr;
    *out++ = ' ';
    if ((out = write_fixed<7>(out, vertex.z)) == nullptr) return nullptr;
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
