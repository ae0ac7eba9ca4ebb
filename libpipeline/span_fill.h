#pragma once

#include <span>

#include "libpipeline/color.h"
#include "libpipeline/depth_format.h"
#include "libpipeline/span.h"

namespace pipeline {

/// A span on its way into a z-buffer of the depth format `Depth`.
template <typename Depth>
struct SpanFill {
  const Span& span;
  Color color;
  const Depth& format;
  double front;                    // what is nearer is not seen
  typename Depth::Stored* depths;  // of the pixel in the span's first column
  Color* colors;                   // likewise
};

// The loop that draws: every pixel of the span whose depth, as it is stored, is less than the one there and
// not less than the front limit gets the span's depth and colour. A kernel is that loop for one kind of
// processor; all give the same bytes.

/// One implementation, for all depth formats.
struct SpanFillKernel {
  const char* name;
  void (*fill_f64)(const SpanFill<DepthF64>&);
  void (*fill_f32)(const SpanFill<DepthF32>&);
  void (*fill_u24)(const SpanFill<DepthU24>&);

  void fill(const SpanFill<DepthF64>& pixels) const { fill_f64(pixels); }
  void fill(const SpanFill<DepthF32>& pixels) const { fill_f32(pixels); }
  void fill(const SpanFill<DepthU24>& pixels) const { fill_u24(pixels); }
};

/// The kernels this processor can run, the fastest last; the first, "portable", runs everywhere.
std::span<const SpanFillKernel> span_fill_kernels();

/// The one in use: the fastest, or the one the environment variable PIPELINE_KERNEL names, for tests. Of the
/// names that mean something to other parts only, "sse4" is "portable" here; any other unknown name is passed
/// over.
const SpanFillKernel& span_fill_kernel();

}  // namespace pipeline
