#pragma once

#include <algorithm>
#include <span>

#include "libpipeline/coverage/span.h"
#include "libpipeline/visibility/depth_format.h"
#include "libpipeline/visibility/hierarchical_depth.h"

namespace pipeline {

/// A span on its way into a row of a z-buffer of the depth format `Depth`. None of its depths is before the
/// front limit.
template <typename Depth>
struct SpanFill {
  using Stored = typename Depth::Stored;

  const Span& span;
  PixelTag tag;
  const Depth& format;
  int columns;                 // of the row
  Stored* depths;              // of its first pixel
  PixelTag* tags;              // likewise
  Stored* farthest = nullptr;  // of its first block (see HierarchicalDepth), updated; may be null
};

/// The blocks of a row that a span reaches, and those that it covers entirely.
struct SpanBlocks {
  template <typename Depth>
  explicit SpanBlocks(const SpanFill<Depth>& pixels)
      : first(pixels.span.first_column / kBlockColumns),
        last(pixels.span.last_column / kBlockColumns),
        first_whole((pixels.span.first_column + kBlockColumns - 1) / kBlockColumns),
        last_whole(pixels.span.last_column + 1 == pixels.columns
                       ? last
                       : (pixels.span.last_column + 1) / kBlockColumns - 1) {}

  int first;
  int last;
  int first_whole;
  int last_whole;  // included
};

// The loop that draws: a pixel gets the span's depth and tag if that depth, as stored, is less than the
// pixel's own. A kernel is that loop for one kind of processor; all give the same bytes.
//
// Every rounding in a SpanDepth is monotone, so depths as they are calculated and stored rise or fall along
// the row: the nearest in a block is at one of its ends. If that is not nearer than the farthest depth there,
// the block is skipped.

/// One implementation, for one depth format.
template <typename Depth>
struct SpanFillKernel {
  const char* name;
  void (*fill)(const SpanFill<Depth>&);
};

/// The kernels this processor can run, the fastest last; the first, "portable", runs everywhere. Vector
/// kernels exist for the formats that have lanes (span_fill_avx2.cpp).
template <typename Depth>
std::span<const SpanFillKernel<Depth>> span_fill_kernels();

/// The kernel "avx2"; null where the processor cannot run it or the format has no lanes.
template <typename Depth>
const SpanFillKernel<Depth>* span_fill_avx2();

/// The kernel in use: the fastest, or the one that the environment variable PIPELINE_KERNEL names, for tests.
/// "sse4", which names kernels elsewhere in the library, means "portable" here; an unknown name is ignored.
template <typename Depth>
const SpanFillKernel<Depth>& span_fill_kernel();

}  // namespace pipeline
