#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

// The fast paths for stage text. Nearly all of it has one form: three lines of numbers and a blank line per
// triangle, all numbers with the same count of decimals (no point if that is 0), and single blanks between
// numbers. That form is read and written here, many digits at a time; everything else is left to the general
// reader and printer. The bytes are the same either way. There is one kernel for each kind of processor,
// chosen once, when the program starts.

/// The largest count of decimals in fixed form. A number has at most 15 digits there: it is a whole number of
/// units of its last decimal that a double holds.
constexpr int kMaxFixedDecimals = 14;

/// The part of a text that is triangles in fixed form.
struct FixedTextPart {
  std::size_t triangle_count = 0;
  std::size_t length = 0;  // in characters
};

/// Readers may read this many characters past the end of the text, whatever they are.
constexpr std::size_t kFixedTextSlack = 320;

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

/// Reads triangles from the beginning of `text` until one is not in fixed form, with `decimals` decimals and
/// at most eight digits before the point, `triangles` is full, or the text ends. Every number becomes the
/// nearest double, as from_chars returns it.
using ReadFixedText = FixedTextPart (*)(std::string_view text, int decimals, std::span<Triangle> triangles);

/// The same for the triangles of a scene: a line `triangle`, then three vertex lines.
using ReadFixedScene = FixedTextPart (*)(std::string_view text, int decimals, std::span<Triangle> triangles);

/// Prints triangles in fixed form and returns how many it printed. Stops before a triangle with a coordinate
/// that has more than 15 digits (kernels differ in 16), or is so close to a tie that only exact arithmetic
/// can round it (one kernel has it). `out` must have room for kMaxFixedTriangleLength characters per
/// triangle, and kFixedTextSlack more.
using WriteFixedText = FixedTextPart (*)(std::span<const Triangle> triangles, int decimals, char* out);

/// Reads three numbers in fixed form with single blanks between them and `separator` after them, for lines
/// with more columns. Returns the position after the separator; null if the form differs. May read as far
/// past the end as the others.
using ReadThreeFixed = const char* (*)(const char* p, int decimals, char separator, Vec3& numbers);

/// Prints three numbers in fixed form with single blanks between them. Returns their end; null if one of them
/// would stop WriteFixedText.
using WriteThreeFixed = char* (*)(const Vec3& numbers, int decimals, char* out);

/// One implementation of all five.
struct FixedTextKernel {
  const char* name;
  ReadFixedText read;
  ReadFixedScene read_scene;
  WriteFixedText write;
  ReadThreeFixed read_three;
  WriteThreeFixed write_three;
};

/// The kernels this processor can run, the fastest last; the first, "portable", runs everywhere.
std::span<const FixedTextKernel> fixed_text_kernels();

/// The kernel in use: the fastest, or the one that the environment variable PIPELINE_KERNEL names
/// (kernel_choice.h).
const FixedTextKernel& fixed_text_kernel();

}  // namespace pipeline
