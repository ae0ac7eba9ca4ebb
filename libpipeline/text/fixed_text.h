#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

// The fast paths for stage text. Nearly all of it has one form: three lines of numbers and a blank line per
// triangle, all numbers with the same count of decimals (no point if that is 0), and single blanks between
// numbers. Where vertex lines have more columns, each group of three has its own count. That form is read and
// written here, many digits at a time; everything else is left to the general reader and printer. The bytes
// are the same either way.

/// The largest count of decimals in fixed form. A number has at most 15 digits there: it is a whole number of
/// units of its last decimal that a double holds.
constexpr int kMaxFixedDecimals = 14;

/// The part of a text that is triangles in fixed form.
struct FixedTextPart {
  std::size_t triangle_count = 0;
  std::size_t length = 0;  // in characters
};

/// Readers may read this many characters past the end of the text, whatever they are.
constexpr std::size_t kFixedTextSlack = 448;

/// The maximum length of a triangle in fixed form: nine numbers of a sign, 16 digits and a point, with a
/// separator each, and a line end.
constexpr std::size_t kMaxFixedTriangleLength = 9 * 19 + 1;

/// The minimum length: nine numbers such as 0.1234567 with a separator each, and a line end.
constexpr std::size_t min_fixed_triangle_length(int decimals) {
  return 9 * (static_cast<std::size_t>(decimals) + (decimals > 0 ? 3 : 2)) + 1;
}

/// The count of decimals, at most kMaxFixedDecimals, to read a text with whose first number begins at `p`.
/// May read 25 characters, whatever they are.
int decimals_of_number(const char* p);

/// The line that belongs to a triangle besides its three vertex lines.
enum class TriangleFrame {
  stage_text,  // a blank line after them
  scene        // the line `triangle` before them
};

/// The numbers on vertex lines, by column: groups of three numbers in fixed form (the position, and up to two
/// more), w, a number in any form, which comes after the position, and last the material, a whole number that
/// the lines of a triangle share. All arrays have an entry per triangle; those of columns that are not there
/// are empty.
template <typename Numbers, typename OneNumber, typename Whole>
struct FixedColumnsOf {
  std::array<std::span<Numbers>, 3> groups;
  std::span<OneNumber> w;
  std::span<Whole> materials = {};

  [[nodiscard]] std::size_t triangle_count() const { return groups[0].size(); }
  [[nodiscard]] std::size_t group_count() const {
    return groups[1].empty() ? 1 : std::size_t{groups[2].empty() ? 2u : 3u};
  }
  /// From 0 to 5: which of the kernels' loops has these columns, by groups and whether there are others.
  [[nodiscard]] std::size_t form() const {
    return 2 * (group_count() - 1) + (w.empty() && materials.empty() ? 0 : 1);
  }
};
using FixedColumns = FixedColumnsOf<Triangle, std::array<double, 3>, std::uint32_t>;
using ConstFixedColumns = FixedColumnsOf<const Triangle, const std::array<double, 3>, const std::uint32_t>;

/// The counts of decimals of the groups.
using GroupDecimals = std::array<int, 3>;

/// Reads triangles with these columns from the beginning of `text` until one is not in fixed form, with these
/// decimals and at most eight digits before the point, the columns are full, or the text ends. Every number
/// becomes the nearest double, as from_chars returns it. Of w it reads the numbers that read_decimal_number
/// reads, of materials those of at most eight digits. Without vectors, it reads nothing.
FixedTextPart read_fixed_columns(std::string_view text, TriangleFrame frame, const GroupDecimals& decimals,
                                 const FixedColumns& columns);

/// Prints triangles in fixed form, with the same decimals in all groups, and w in its shortest form, as
/// print_number prints it. Stops before a triangle with a number that has more than 15 digits, or is so close
/// to a tie that only exact arithmetic can round it (some kernels have it). `out` must have room for
/// kMaxFixedTriangleLength or, with more columns, kMaxFixedColumnsLength characters per triangle, and
/// kFixedTextSlack more.
FixedTextPart write_fixed_columns(const ConstFixedColumns& columns, int decimals, char* out);

/// Three groups of numbers; three times w and a material with a separator each.
constexpr std::size_t kMaxFixedColumnsLength = std::size_t{3} * (kMaxFixedTriangleLength + 26 + 11);

/// The kernels of write_fixed_columns. The scalar one prints nothing.
using WriteFixedColumns = FixedTextPart (*)(const ConstFixedColumns& columns, int decimals, char* out);
const KernelTable<WriteFixedColumns>& fixed_printing_kernels();

// The fast path for vertex lines whose numbers have each a count of decimals of their own, as `--digits
// exact` and people write them: without exponents, and with single blanks between them. Whole triangles at a
// time.

/// Which of a triangle's coordinates have at most kExactDecimals (number_parser.h): bit 3 * vertex + axis.
using DecimalMarks = std::uint16_t;

/// Like read_fixed_columns, for numbers that read_decimal_number reads. `marks` has an entry per triangle.
FixedTextPart read_decimal_columns(std::string_view text, TriangleFrame frame, const FixedColumns& columns,
                                   std::span<DecimalMarks> marks);

/// Ten numbers of at most 24 characters and a material on a line, with a separator each.
constexpr std::size_t kMaxShortestColumnsLength = 3 * (10 * 26 + 11) + 1;

/// Prints triangles with all their numbers in the shortest form (number_printer.h) and returns their end.
/// `out` must have room for kMaxShortestColumnsLength characters per triangle, and kFixedTextSlack more.
char* write_shortest_columns(const ConstFixedColumns& columns, char* out);

/// Prints triangles in this format by the printer above that has it, as many as that takes, and returns their
/// count: 0 for more than kMaxFixedDecimals.
std::size_t write_columns(const ConstFixedColumns& columns, NumberFormat format, TextWriter& text);

}  // namespace pipeline
