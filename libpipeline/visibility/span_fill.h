#pragma once

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/kernel_choice.h"
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

/// The blocks of a row that a span reaches, and the blocks that it covers entirely.
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

template <typename Depth>
using FillSpan = void (*)(const SpanFill<Depth>&);

/// The kernels of a depth format.
template <typename Depth>
const KernelTable<FillSpan<Depth>>& span_fill_kernels();

}  // namespace pipeline
