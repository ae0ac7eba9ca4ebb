#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "libpipeline/text/fixed_text.h"

namespace pipeline {

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

}  // namespace pipeline
