#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/rules.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/zbuffer.h"

namespace pipeline {

/// Spans on their way into a buffer of pixels. The pixels of two small triangles are far apart in memory, so
/// a span is queued while its pixels are fetched into the cache. First in, first out.
class SpanQueue {
 public:
  /// `most_spans` is the maximum for one call of `put`.
  explicit SpanQueue(std::size_t most_spans)
      : spans_(std::make_unique_for_overwrite<TaggedSpan[]>(kWaiting + most_spans)), end_(spans_.get()) {}

  /// The place for the next spans, one after the other.
  [[nodiscard]] TaggedSpan* end() { return end_; }
  /// Queues the spans written there, up to `new_end`. Calls `fetch(span)` for each immediately, and
  /// `draw(spans)` for all queued spans once there are many.
  template <typename Fetch, typename Draw>
  void put(TaggedSpan* new_end, Fetch&& fetch, Draw&& draw) {
    for (; end_ != new_end; ++end_) fetch(*end_);
    if (end_ >= spans_.get() + kWaiting) finish(draw);
  }
  /// Calls `draw(spans)` for all spans still queued.
  template <typename Draw>
  void finish(Draw&& draw) {
    draw(std::span<const TaggedSpan>(spans_.get(), end_));
    end_ = spans_.get();
  }

 private:
  // The number of spans fetched before the first of them is drawn.
  static constexpr std::size_t kWaiting = 64;

  std::unique_ptr<TaggedSpan[]> spans_;  // not initialized: they are written before they are read
  TaggedSpan* end_;
};

// A visibility algorithm receives the triangles of the stream one by one, and then reports, row by row, the
// visible triangle at every pixel and its depth. The visible triangle is the one with the smallest depth
// between the limits, as the depth format stores it; among equal depths, the earliest. So the result does not
// depend on the algorithm. An algorithm is a class template with a coverage rule and a depth format as
// arguments; it is constructed from the viewport, and has draw(triangle, tag) and for_each_row(visit).

/// The z-buffer: draws a triangle, or its part in some rows, as soon as it arrives; threads may draw into
/// different rows at the same time.
template <typename Coverage, typename Depth>
class ZBufferAlgorithm {
 public:
  explicit ZBufferAlgorithm(const Viewport& screen, PixelTag background = {})
      : coverage_(screen),
        rows_(screen.drawn_rows()),
        buffer_(screen, background),
        most_height_((kMaxRows - 1) * screen.dy()) {}

  /// Lets a fragment win only if it is nearer than the visible one by more than `epsilon`.
  void set_depth_epsilon(double epsilon) { buffer_.set_depth_epsilon(epsilon); }
  void draw(const ExactTriangle& triangle, PixelTag tag) {
    for_each_span(coverage_.rows(triangle), rows_, [&](const Span& span) { buffer_.draw(span, tag); });
  }
  /// Draws into some or all of the drawn rows, triangle by triangle; nothing else may draw there in the
  /// meantime.
  class Drawer {
   public:
    Drawer(ZBufferAlgorithm& algorithm, const RowRange& rows)
        : algorithm_(algorithm),
          rows_(rows),
          is_low_(rows.end - rows.first <= kMaxRows),
          farthest_(algorithm.buffer_.hierarchical_depth(rows)),
          queue_(kTriangles * kMaxRows) {
      triangles_.reserve(kTriangles);
    }
    /// Draws the triangle, at the latest in finish(); until then, its coordinates must stay in memory.
    [[gnu::always_inline]] void draw(const ExactTriangle& triangle, PixelTag tag) {
      triangles_.push_back({triangle, tag});
      if (!is_low_) is_any_high_ |= !(height_of(triangle.p_ndc) < algorithm_.most_height_);
      if (triangles_.size() == kTriangles) make_spans();
    }
    void finish() {
      make_spans();
      queue_.finish([this](std::span<const TaggedSpan> spans) { draw_spans(spans); });
    }

   private:
    // The count that a coverage kernel processes at a time, or a multiple of it.
    static constexpr std::size_t kTriangles = 4;

    static double height_of(const Triangle& p_ndc) {
      const double a = p_ndc[0].y, b = p_ndc[1].y, c = p_ndc[2].y;
      return std::max(std::max(a, b), c) - std::min(std::min(a, b), c);
    }
    void make_spans() {
      const auto draw_waiting = [this](std::span<const TaggedSpan> spans) { draw_spans(spans); };
      if (!is_any_high_) {
        queue_.put(
            spans_by(algorithm_.coverage_, triangles_, rows_, queue_.end()),
            [this](const TaggedSpan& span) { algorithm_.buffer_.fetch(span.span); }, draw_waiting);
      } else {
        queue_.finish(draw_waiting);
        for (const auto& [triangle, tag] : triangles_)
          for_each_span(algorithm_.coverage_.rows(triangle), rows_,
                        [&, of = tag](const Span& span) { algorithm_.buffer_.draw(span, of); });
      }
      triangles_.clear();
      is_any_high_ = false;
    }
    // For many rows, draws without depth bounds: the bounds of a whole tall picture would take too much
    // memory.
    void draw_spans(std::span<const TaggedSpan> spans) {
      algorithm_.buffer_.draw(spans, is_low_ ? &farthest_ : nullptr);
    }

    ZBufferAlgorithm& algorithm_;
    RowRange rows_;
    bool is_low_;
    HierarchicalDepth<Depth> farthest_;
    std::vector<TaggedTriangle> triangles_;
    bool is_any_high_ = false;  // set only where it matters
    SpanQueue queue_;
  };

  /// Calls `visit(tags)`, which may change the tags, for every row with something drawn. No drawer may be in
  /// use.
  template <typename Visitor>
  void for_each_drawn_row(Visitor&& visit) {
    buffer_.for_each_drawn_row(visit);
  }
  template <typename Visitor>
  void for_each_row(Visitor&& visit) const {
    buffer_.for_each_row(visit);
  }

 private:
  // The maximum number of rows of a triangle whose spans are queued. Only pictures with more than 65536 rows
  // of samples have higher bands.
  static constexpr int kMaxRows = 128;

  Coverage coverage_;
  RowRange rows_;  // the rows that are drawn
  ZBuffer<Depth> buffer_;
  double most_height_;  // of a triangle with less than kMaxRows rows
};
}  // namespace pipeline
