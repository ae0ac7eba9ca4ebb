#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {

// Shared by the fast paths for vertex lines (fixed_reading.cpp, fixed_printing.cpp, column_codec.cpp).

/// The beginning of the vertex lines; null if the line before them is missing.
inline const char* vertex_lines(const char* p, TriangleFrame frame) {
  constexpr std::string_view kLine = "triangle\n";
  if (frame == TriangleFrame::stage_text) return p;
  return std::string_view(p, kLine.size()) == kLine ? p + kLine.size() : nullptr;
}
/// The end of a triangle whose vertex lines end at `p`; null if the line after them is missing.
inline const char* triangle_end(const char* p, TriangleFrame frame) {
  if (frame == TriangleFrame::scene) return p;
  return *p == '\n' ? p + 1 : nullptr;
}

// Colors mostly repeat from vertex to vertex: three numbers with the same text or values as at the last
// vertex are copied. This is tried for the first group after the position, where colors are, until it has
// failed twice in a row in a block.
constexpr std::size_t kRepeatedGroup = 1;
constexpr int kMaxMissesInARow = 2;

/// Three numbers that were read, and their text up to the separator after them.
class LastRead {
 public:
  /// True if the same text is at `p`; always false once colors have stopped repeating.
  [[nodiscard]] bool is_at(const char* p) {
    if (miss_count_ == kMaxMissesInARow) return false;
    // Texts that differ mostly do so in their first eight characters.
    const bool repeats =
        length_ > 0 && load_eight(p) == load_eight(text_) && std::memcmp(p, text_, length_) == 0;
    miss_count_ = repeats ? 0 : miss_count_ + 1;
    return repeats;
  }
  void set(const char* begin, const char* end, const Vec3& numbers) {
    if (miss_count_ == kMaxMissesInARow) return;
    text_ = begin;
    length_ = static_cast<std::size_t>(end - begin);
    numbers_ = numbers;
  }
  [[nodiscard]] std::size_t length() const { return length_; }
  [[nodiscard]] const Vec3& numbers() const { return numbers_; }

 private:
  const char* text_ = nullptr;
  std::size_t length_ = 0;  // 0: none yet
  Vec3 numbers_;
  int miss_count_ = 0;  // in a row
};

/// Three numbers that were printed, and their text with a blank after each.
class LastPrinted {
 public:
  /// True if all vertices of the triangle have these; always false once colors have stopped repeating.
  [[nodiscard]] bool is_of(const Triangle& triangle) {
    if (miss_count_ == kMaxMissesInARow) return false;
    const auto& [a, b, c] = triangle;
    const bool repeats = length_ > 0 && a == numbers_ && b == a && c == a;
    miss_count_ = repeats ? 0 : miss_count_ + 1;
    return repeats;
  }
  /// `out` is the end of the text; kMaxLength characters from `begin` on are copied, whatever they are.
  void set(const Vec3& printed, const char* begin, const char* out) {
    if (miss_count_ == kMaxMissesInARow) return;
    std::memcpy(text_.data(), begin, kMaxLength);
    length_ = static_cast<std::size_t>(out - begin);
    numbers_ = printed;
  }
  char* print(char* out) const {
    std::memcpy(out, text_.data(), kMaxLength);
    return out + length_;
  }

 private:
  static constexpr std::size_t kMaxLength = 64;  // more than three numbers with a sign, 16 digits and a point

  std::array<char, kMaxLength> text_{};
  std::size_t length_ = 0;  // 0: none yet
  Vec3 numbers_;
  int miss_count_ = 0;  // in a row
};

/// Reads a number and the separator after it; null if the form differs.
inline const char* read_w(const char* p, char separator, double& value) {
  DecimalNumber number;
  p = read_decimal_number(p, number);
  value = number.value;
  return p == nullptr || *p != separator ? nullptr : p + 1;
}

/// Reads the material and the end of a line; null if the form or the triangle's material differs.
inline const char* read_material(const char* p, std::size_t vertex, std::uint32_t& material) {
  const std::uint64_t less_zeros = load_eight(p) - kEightZeros;
  const std::size_t count = leading_digit_count(less_zeros);
  if (count == 0 || p[count] != '\n') return nullptr;
  const auto number = static_cast<std::uint32_t>(join_leading_digits(less_zeros, count));
  if (vertex == 0) material = number;
  return number == material ? p + count + 1 : nullptr;
}

/// Ends a line whose last character is a blank, with its triangle's material if there is such a column.
inline char* write_line_end(char* out, std::span<const std::uint32_t> materials, std::size_t triangle) {
  if (!materials.empty()) out = std::to_chars(out, out + 10, materials[triangle]).ptr + 1;
  out[-1] = '\n';
  return out;
}

/// The limit for printing: numbers are read and printed as whole numbers of units of their last decimal.
constexpr double kUnitsLimit = 1e15;

}  // namespace pipeline
