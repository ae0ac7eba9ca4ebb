#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/text_writer.h"
#include "libpipeline/text/vertex_columns.h"

namespace pipeline {

// The fast paths for stage text. Nearly all of it is in fixed form: three lines of numbers and a blank line
// per triangle, all numbers with the same count of decimals (no point if it is 0), and single blanks between
// numbers. Where vertex lines have more columns, each group of three has its own count. Text in this form is
// read and written many digits at a time; the general reader and printer do the rest. The bytes are the same
// either way.

/// The largest count of decimals in fixed form. A number in this form has at most 15 digits, so a double
/// holds it exactly as a whole number of units of its last decimal.
constexpr int kMaxFixedDecimals = 14;

/// The part of a text that consists of triangles in fixed form, or in the form of vertex lines below.
struct FixedTextPart {
  std::size_t triangle_count = 0;
  std::size_t length = 0;            // in characters
  std::optional<int> decimals = {};  // of every coordinate, if all have the same count
};

/// Readers may load up to this many characters past the end of the text; their values do not matter.
constexpr std::size_t kFixedTextSlack = 448;

/// A bound on the length of a triangle in fixed form: nine numbers, each with a sign, 16 digits (one to
/// spare), a point and a separator, and one line end.
constexpr std::size_t kMaxFixedTriangleLength = 9 * 19 + 1;

/// The minimum length: nine numbers such as 0.1234567, each with a separator, and a line end.
constexpr std::size_t min_fixed_triangle_length(int decimals) {
  return 9 * (static_cast<std::size_t>(decimals) + (decimals > 0 ? 3 : 2)) + 1;
}

/// The count of decimals to read a text with, at most kMaxFixedDecimals; its first number is at `p`. May load
/// 25 characters, whatever they are.
int decimals_of_number(const char* p);

/// The line that belongs to a triangle besides its three vertex lines.
enum class TriangleFrame {
  stage_text,  // a blank line after the vertex lines
  scene        // the line `triangle` before the vertex lines
};

/// The position, and the attributes that have three numbers.
constexpr std::size_t kMaxGroups = 1 + attribute_count<Vec3>(kAttributes);
// The other columns are w, after the position, and the material.
static_assert(std::is_same_v<decltype(std::get<0>(kAttributes)), const VertexAttribute<double>&>);
static_assert(attribute_count<double>(kAttributes) == 1);

/// The numbers on vertex lines, by column: groups of three numbers in fixed form (the position first), w in
/// any form after the position, and last the material, a whole number that the lines of a triangle share. All
/// arrays have an entry per triangle; the arrays of missing columns are empty.
template <typename Numbers, typename OneNumber, typename Whole>
struct FixedColumnsOf {
  std::array<std::span<Numbers>, kMaxGroups> groups;
  std::span<OneNumber> w = {};
  std::span<Whole> materials = {};

  [[nodiscard]] std::size_t triangle_count() const { return groups[0].size(); }
  [[nodiscard]] std::size_t group_count() const {
    std::size_t count = 1;
    while (count < kMaxGroups && !groups[count].empty()) ++count;
    return count;
  }
  /// The character after a group or, if it is the position, after its w.
  [[nodiscard]] char separator_after(std::size_t group) const {
    return group + 1 == group_count() && materials.empty() ? '\n' : ' ';
  }
  /// True if there are only groups.
  [[nodiscard]] bool has_groups_alone() const { return w.empty() && materials.empty(); }
  /// The index of these columns' loop in FixedReaders, by the count of groups and whether there are others.
  [[nodiscard]] std::size_t form() const { return 2 * (group_count() - 1) + (has_groups_alone() ? 0 : 1); }
};
using FixedColumns = FixedColumnsOf<Triangle, std::array<double, 3>, std::uint32_t>;
using ConstFixedColumns = FixedColumnsOf<const Triangle, const std::array<double, 3>, const std::uint32_t>;

/// The columns of `count` triangles from `begin` on; `names` lists the columns after the position.
template <typename Positions, typename Attributes>
auto fixed_columns(Positions& positions, Attributes& attributes, const AttributeSet& names, std::size_t begin,
                   std::size_t count) {
  std::conditional_t<std::is_const_v<Positions>, ConstFixedColumns, FixedColumns> columns;
  const auto part = [&](auto& array) { return std::span(array).subspan(begin, count); };
  columns.groups[0] = part(positions);
  std::size_t group = 0;
  for_each_attribute([&]<typename Value>(const VertexAttribute<Value>& attribute) {
    if constexpr (std::is_same_v<Value, Vec3>)
      if (names.*attribute.is_there) columns.groups[++group] = part(attributes.*attribute.array);
  });
  if (names.w) columns.w = part(attributes.w);
  if (names.material) columns.materials = part(attributes.materials);
  return columns;
}

/// The counts of decimals of the groups.
using GroupDecimals = std::array<int, kMaxGroups>;

/// Reads triangles from the beginning of `text` until the columns are full, the text ends, or a triangle is
/// not in fixed form with these decimals and at most eight digits before the point. Every number becomes the
/// nearest double, as from_chars returns it. A w must suit read_decimal_number, and a material has at most
/// eight digits. The scalar kernel reads nothing.
using ReadFixedColumns = FixedTextPart (*)(std::string_view text, TriangleFrame frame,
                                           const GroupDecimals& decimals, const FixedColumns& columns);
/// The functions of the kernel in use, by the form of the columns (FixedColumnsOf::form).
using FixedReaders = std::array<ReadFixedColumns, 2 * kMaxGroups>;
const FixedReaders& fixed_readers();

/// Prints triangles in fixed form, from `first` on, with the same decimals in all groups, and w in its
/// shortest form. Stops before a triangle with a number that has more than 15 digits, or is so close to a tie
/// that only exact arithmetic, which some kernels have, can round it. `out` must have room for
/// kMaxFixedTriangleLength or, with more columns, kMaxFixedColumnsLength characters per triangle, and
/// kFixedTextSlack more. The scalar kernel prints nothing.
using WriteFixedColumns = FixedTextPart (*)(const ConstFixedColumns& columns, std::size_t first, int decimals,
                                            char* out);
extern const KernelTable<WriteFixedColumns> kFixedPrintingKernels;

/// The groups, and on each of three lines w and a material with a separator after each.
constexpr std::size_t kMaxFixedColumnsLength =
    kMaxGroups * kMaxFixedTriangleLength + std::size_t{3} * (26 + 11);

// The codec of vertex lines. Besides the fixed form, it has a fast path for numbers with different counts of
// decimals, as `--digits exact` and people write them: without exponents, and with single blanks between
// them.

/// Reads triangles with these columns from the beginning of `text` as long as they have the form of the
/// first: the fixed form, or numbers for read_decimal_number. In the second form, it reads at most as many
/// triangles as `marks` has entries, which it sets. The general reader reads the rest.
FixedTextPart read_columns(std::string_view text, TriangleFrame frame, const FixedColumns& columns,
                           std::span<DecimalMarks> marks);

/// Prints triangles in this format, w always in its shortest form: by the fixed printer, or number by number
/// where it stops. `low_part`, which may be null, holds the low parts of each triangle's positions
/// (TriangleBatch).
void write_columns(const ConstFixedColumns& columns, const Triangle* low_part, NumberFormat format,
                   TextWriter& text);

}  // namespace pipeline
