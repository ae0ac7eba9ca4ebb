#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/visibility/depth_format.h"

namespace pipeline {

/// The length of a block of neighboring pixels in a row; a block's first column is a multiple of it.
constexpr int kBlockColumns = 32;

/// An upper bound on the depths in each block, for some rows of a z-buffer. Stored depths only decrease, so a
/// bound stays valid without updates. A span that is nowhere nearer than the bound within a block is hidden
/// in the whole block. Source: N. Greene, M. Kass, G. Miller, "Hierarchical Z-buffer visibility", 1993.
/// `Depth` is a depth format.
template <typename Depth>
class HierarchicalDepth {
 public:
  using Stored = typename Depth::Stored;
  /// Kernels may read this many bounds past the last block of a row.
  static constexpr std::size_t kPadding = 7;

  /// Bounds for rows of `columns` pixels; allocated at the first call of row().
  HierarchicalDepth(const RowRange& rows, int columns)
      : rows_(rows), stride_(static_cast<std::size_t>((columns + kBlockColumns - 1) / kBlockColumns)) {}

  /// The bounds of a row, block by block; at first, no depth exceeds them.
  [[nodiscard]] Stored* row(int row) {
    if (farthest_.empty()) farthest_.assign(stride_ * row_count(rows_.end) + kPadding, kLargest);
    return &farthest_[stride_ * row_count(row)];
  }

 private:
  static constexpr Stored kLargest = std::numeric_limits<Stored>::has_infinity
                                         ? std::numeric_limits<Stored>::infinity()
                                         : std::numeric_limits<Stored>::max();
  [[nodiscard]] std::size_t row_count(int end) const { return static_cast<std::size_t>(end - rows_.first); }

  RowRange rows_;
  std::size_t stride_;
  std::vector<Stored> farthest_;
};

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
  PixelTag* tags;              // of its first pixel
  Stored* farthest = nullptr;  // of its first block, updated (HierarchicalDepth); may be null
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
// pixel's own. A kernel is this loop for one kind of processor; all give the same bytes.
// Every rounding in a SpanDepth is monotone, so stored depths, too, rise or fall along the row: the nearest
// in a block is at one of its ends. If it is not nearer than the block's bound, the block is skipped.

template <typename Depth>
using FillSpan = void (*)(const SpanFill<Depth>&);

/// The kernels of a depth format.
template <typename Depth>
const KernelTable<FillSpan<Depth>>& span_fill_kernels();

}  // namespace pipeline
