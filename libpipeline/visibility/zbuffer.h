#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/depth_format.h"
#include "libpipeline/visibility/raster.h"
#include "libpipeline/visibility/span_fill.h"

namespace pipeline {

/// The visibility algorithm `zbuffer`: every pixel keeps the nearest depth drawn so far and its tag, 12 bytes
/// if depths are doubles. A row is filled with the background when something is first drawn there, so small
/// scenes touch little memory. `Depth` is a depth format. Source: E. Catmull, "A subdivision algorithm for
/// computer display of curved surfaces", 1974.
template <typename Depth = DepthF64>
class ZBuffer {
 public:
  /// A buffer for the screen's drawn rows, with every pixel at the rear limit and the tag `background`.
  explicit ZBuffer(const Viewport& screen, PixelTag background = {});

  /// Draws a span of the triangle with this tag. A pixel is written if its depth is not less than the front
  /// limit and, as stored, less than the depth there (among equal depths, the first drawn stays). `farthest`,
  /// if not null, has rows of this buffer; its bounds stay valid even if others draw into these rows.
  void draw(const Span& span, PixelTag tag, HierarchicalDepth<Depth>* farthest = nullptr);

  /// Draws several spans, one after the other.
  void draw(std::span<const TaggedSpan> spans, HierarchicalDepth<Depth>* farthest);

  /// Prefetches the first pixels of a span that will be drawn soon.
  void fetch(const Span& span) const {
    const auto column = static_cast<std::size_t>(span.first_column);
    __builtin_prefetch(&depths_.row(span.row)[column], 1);
    __builtin_prefetch(&tags_.row(span.row)[column], 1);
  }

  /// Lets a pixel that shows a triangle be written only if the new depth is less by more than `epsilon`, at
  /// least 0. The picture then depends on the order of the triangles.
  void set_depth_epsilon(double epsilon) { depth_epsilon_ = epsilon; }

  /// Depth bounds for drawing into these rows.
  [[nodiscard]] HierarchicalDepth<Depth> hierarchical_depth(const RowRange& rows) const {
    return {rows, depths_.columns()};
  }

  /// Calls `visit(tags)`, which may change the tags, for every row with something drawn.
  template <typename Visitor>
  void for_each_drawn_row(Visitor&& visit) {
    for (int row = rows_.first; row < rows_.end; ++row)
      if (is_filled_[index_of(row)] != 0) visit(tags_.row(row));
  }
  /// Calls `visit(VisibleRow)` for every row of the buffer, empty ones, too, from the top.
  template <typename Visitor>
  void for_each_row(Visitor&& visit) const {
    const auto columns = static_cast<std::size_t>(depths_.columns());
    const std::vector<double> no_depths(columns, rear_limit_);
    const std::vector<PixelTag> no_tags(columns, background_);
    std::vector<double> depths(columns);
    for (int row = rows_.first; row < rows_.end; ++row) {
      if (!is_filled_[index_of(row)]) {
        visit(VisibleRow{no_depths, no_tags});
        continue;
      }
      // Copies of members, which writing to `depths` cannot change: so the compiler vectorizes the loop.
      const auto depth = [format = format_, rear = rear_, limit = rear_limit_](Stored stored) {
        return stored < rear ? format.depth(stored) : limit;
      };
      std::transform(depths_.row(row).begin(), depths_.row(row).end(), depths.begin(), depth);
      visit(VisibleRow{depths, tags_.row(row)});
    }
  }

 private:
  using Stored = typename Depth::Stored;

  [[nodiscard]] std::size_t index_of(int row) const { return static_cast<std::size_t>(row - rows_.first); }
  /// Must precede any drawing into a row.
  void fill_row(int row);
  void draw_in_filled_row(const Span& span, PixelTag tag, HierarchicalDepth<Depth>* farthest);
  [[nodiscard]] Span part_behind_front(const Span& span) const;
  void draw_what_is_nearer_by_epsilon(const Span& span, PixelTag tag);

  void (*fill_)(const SpanFill<Depth>&);
  Depth format_;
  double front_;
  double rear_limit_;
  Stored rear_;
  double depth_epsilon_ = 0;
  PixelTag background_;
  RowRange rows_;  // the rows that are drawn
  Raster<Stored> depths_;
  Raster<PixelTag> tags_;
  // One byte per row, not bits: threads draw into different rows at the same time.
  std::vector<std::uint8_t> is_filled_;
};

}  // namespace pipeline
