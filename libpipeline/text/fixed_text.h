#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

// The fast paths of stage text. Nearly all of it looks the same: numbers of up to eight digits, a point and
// seven decimals, one blank between, three lines and a blank one a triangle. That form is read and written
// here, many digits at a time; whatever differs is left to the general reader and printer, and the bytes are
// the same. There is one kernel a kind of processor; which one runs is decided once, when the program starts.

/// How much of a text is plain triangles.
struct FixedTextPart {
  std::size_t triangle_count = 0;
  std::size_t length = 0;  // of their text, in characters
};

/// Reading may look this many characters beyond the end of the text; they need not mean anything.
constexpr std::size_t kFixedTextSlack = 320;

/// The most characters a triangle in fixed form takes: nine numbers with a separator each, and a line end.
constexpr std::size_t kMaxFixedTriangleLength = 9 * 18 + 1;

/// Reads triangles in fixed form from the beginning of `text` until one is not, or `triangles` is full, or
/// the text ends. A number becomes the double nearest to it, as from_chars gives it.
using ReadFixedText = FixedTextPart (*)(std::string_view text, std::span<Triangle> triangles);

/// The same for the triangles of a scene: a line `triangle`, then three vertex lines.
using ReadFixedScene = FixedTextPart (*)(std::string_view text, std::span<Triangle> triangles);

/// Prints triangles in fixed form until there is one of which a coordinate has more than eight digits before
/// the point, or lies so near to a tie that it takes exact arithmetic to round it; says how many were
/// printed. `out` has room for kMaxFixedTriangleLength each, and kFixedTextSlack more.
using WriteFixedText = FixedTextPart (*)(std::span<const Triangle> triangles, char* out);

/// One implementation of them all.
struct FixedTextKernel {
  const char* name;
  ReadFixedText read;
  ReadFixedScene read_scene;
  WriteFixedText write;
};

/// The kernels this processor can run, the fastest last; the first, "portable", runs everywhere.
std::span<const FixedTextKernel> fixed_text_kernels();

/// The one in use: the fastest, or the one the environment variable PIPELINE_KERNEL names (kernel_choice.h).
const FixedTextKernel& fixed_text_kernel();

}  // namespace pipeline
