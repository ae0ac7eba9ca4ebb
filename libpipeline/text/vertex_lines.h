#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "libpipeline/text/decimal_number.h"
#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/number_printer.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define PIPELINE_HAS_X86_KERNELS
#endif

namespace pipeline {

// The kernels of fixed_text.h, each in a file of its own.

/// The beginning of the vertex lines; null if the line before them is missing.
template <TriangleFrame frame>
const char* vertex_lines(const char* p) {
  if constexpr (frame == TriangleFrame::stage_text) return p;
  constexpr std::string_view kLine = "triangle\n";
  return std::string_view(p, kLine.size()) == kLine ? p + kLine.size() : nullptr;
}

/// The same for a frame that is known only here.
inline const char* vertex_lines(const char* p, TriangleFrame frame) {
  return frame == TriangleFrame::scene ? vertex_lines<TriangleFrame::scene>(p) : p;
}
/// The end of a triangle whose vertex lines end at `p`; null if the line after them is missing.
inline const char* triangle_end(const char* p, TriangleFrame frame) {
  if (frame == TriangleFrame::scene) return p;
  return *p == '\n' ? p + 1 : nullptr;
}

// Colors mostly repeat from vertex to vertex: three numbers whose text or values are those of the last vertex
// are copied. This is tried for the first group after the position, where colors stand, and not any more in a
// block where it failed twice in a row.
constexpr std::size_t kRepeatedGroup = 1;
constexpr int kMaxMissesInARow = 2;

/// Three numbers that were read, and their text up to the separator after them.
class LastRead {
 public:
  /// Whether the same text stands at `p`; false where colors do not repeat.
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
  /// Whether these are the same numbers; false where colors do not repeat.
  [[nodiscard]] bool is_of(const Vec3& three) {
    return miss_count_ < kMaxMissesInARow && counted(length_ > 0 && three == numbers_);
  }
  /// Whether all vertices of the triangle have them.
  [[nodiscard]] bool is_of(const Triangle& triangle) {
    const auto& [a, b, c] = triangle;
    return miss_count_ < kMaxMissesInARow && counted(length_ > 0 && a == numbers_ && b == a && c == a);
  }
  /// `out` is the end of the text; kMaxLength characters from its beginning are copied, whatever they are.
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
  bool counted(bool repeats) {
    miss_count_ = repeats ? 0 : miss_count_ + 1;
    return repeats;
  }

  static constexpr std::size_t kMaxLength = 64;  // more than three numbers of a sign, 16 digits and a point

  std::array<char, kMaxLength> text_;
  std::size_t length_ = 0;  // 0: none yet
  Vec3 numbers_;
  int miss_count_ = 0;  // in a row
};

/// Reads w and the separator after it; null if the form differs.
inline const char* read_w(const char* p, char separator, double& w) {
  DecimalNumber number;
  p = read_decimal_number(p, number);
  w = number.value;
  return p != nullptr && *p == separator ? p + 1 : nullptr;
}

/// Reads up to `limit` triangles, as long as `read_line(p, triangle, vertex)` reads their lines: it returns
/// the beginning of the next line, or null if the form differs.
template <typename ReadLine>
FixedTextPart read_by_lines(std::string_view text, TriangleFrame frame, std::size_t limit,
                            const ReadLine& read_line) {
  const char* const end = text.data() + text.size();
  FixedTextPart part;
  for (std::size_t i = 0; i < limit && part.length < text.size(); ++i) {
    const char* p = vertex_lines(text.data() + part.length, frame);
    for (std::size_t vertex = 0; vertex < 3 && p != nullptr; ++vertex)
      p = p < end ? read_line(p, i, vertex) : nullptr;
    if (p == nullptr || (p = triangle_end(p, frame)) == nullptr || p > end) break;
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(p - text.data());
  }
  return part;
}

/// Prints w and a blank.
inline char* write_w(char* out, double w) {
  out = print_shortest(out, w);
  *out = ' ';
  return out + 1;
}

/// Numbers are read and printed as whole numbers of units of their last decimal; those printed are below
/// this.
constexpr double kUnitsLimit = 1e15;

extern const FixedTextKernel kPortableKernel;

#ifdef PIPELINE_HAS_X86_KERNELS
/// How to print the sixteen digits of a whole number of units, the first of which is 0 and replaced by a
/// point.
struct PrintedForm {
  /// Sixteen bytes starting at byte n form a shuffle mask that drops the first n digits and moves the point
  /// to its position.
  alignas(16) std::array<std::uint8_t, 32> shuffle{};
  unsigned last_whole_digit = 0;  // a bit
  unsigned length = 0;            // of sixteen digits and, if there are decimals, the point
  unsigned length_of_zero = 0;    // without a sign

  constexpr explicit PrintedForm(unsigned decimals = 0)
      : last_whole_digit(1u << (15 - decimals)),
        length(decimals > 0 ? 17 : 16),
        length_of_zero(length + decimals - 15) {
    const unsigned point = 16 - decimals;
    for (unsigned i = 0; i < 32; ++i)
      shuffle[i] = static_cast<std::uint8_t>(i < point ? i : i == point ? 0 : i - 1);
  }
};

inline constexpr auto kPrintedForms = [] {
  std::array<PrintedForm, kMaxFixedDecimals + 1> forms;
  for (unsigned decimals = 0; decimals < forms.size(); ++decimals) forms[decimals] = PrintedForm(decimals);
  return forms;
}();

/// The digits to print: '0' is added to all but the first, which is 0 and becomes the point.
alignas(16) inline constexpr std::array<char, 16> kPointAndZeros = {'.', '0', '0', '0', '0', '0', '0', '0',
                                                                    '0', '0', '0', '0', '0', '0', '0', '0'};

extern const FixedTextKernel kSse4Kernel;
bool processor_has_sse4();
// Reading gains nothing from wider registers: where a number begins depends on the one before it.
extern const WriteFixedText kWriteFixedTextAvx2;
extern const WriteFixedColumns kWriteFixedColumnsAvx2;
bool processor_has_avx2();
#endif

}  // namespace pipeline
