#pragma once

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
      : coverage_(screen), rows_(screen.drawn_rows()), buffer_(screen, background) {}

  /// Lets a fragment win only if it is nearer than the visible one by more than `epsilon`.
  void set_depth_epsilon(double epsilon) { buffer_.set_depth_epsilon(epsilon); }
  void draw(const ExactTriangle& triangle, PixelTag tag) {
    for_each_span(coverage_.rows(triangle), rows_, [&](const Span& span) { buffer_.draw(span, tag); });
  }
  /// Draws into some or all of the drawn rows, triangle by triangle; nothing else may draw there in the
  /// meantime. The pixels of two small triangles are far apart in memory, so spans are queued while their
  /// pixels are fetched into the cache.
  class Drawer {
   public:
    Drawer(ZBufferAlgorithm& algorithm, const RowRange& rows)
        : algorithm_(algorithm),
          rows_(rows),
          is_low_(rows.end - rows.first <= kMaxLowRows),
          farthest_(algorithm.buffer_.hierarchical_depth(rows)),
          spans_(std::make_unique_for_overwrite<TaggedSpan[]>(
              kWaiting + kTriangles * static_cast<std::size_t>(rows.end - rows.first))),
          end_(spans_.get()) {
      triangles_.reserve(kTriangles);
    }
    /// Draws the triangle, at the latest in finish(); until then, its coordinates must stay in memory.
    [[gnu::always_inline]] void draw(const ExactTriangle& triangle, PixelTag tag) {
      triangles_.push_back({triangle, tag});
      if (triangles_.size() == kTriangles) make_spans();
    }
    void finish() {
      make_spans();
      draw_spans();
    }

   private:
    // The count that a coverage kernel processes at a time, or a multiple of it.
    static constexpr std::size_t kTriangles = 4;
    // The number of spans fetched before the first of them is drawn.
    static constexpr std::size_t kWaiting = 64;
    // The most rows with depth bounds. Only pictures with more than 65536 rows of samples have higher bands.
    static constexpr int kMaxLowRows = 128;

    void make_spans() {
      TaggedSpan* const end = algorithm_.coverage_.spans(triangles_, rows_, end_);
      if (!is_low_)  // not for a band: its pixels are in the cache
        for (const TaggedSpan* span = end_; span != end; ++span) algorithm_.buffer_.fetch(span->span);
      end_ = end;
      if (end_ >= spans_.get() + kWaiting) draw_spans();
      triangles_.clear();
    }
    // For many rows, draws without depth bounds: the bounds of a whole tall picture would take too much
    // memory.
    void draw_spans() {
      algorithm_.buffer_.draw(std::span<const TaggedSpan>(spans_.get(), end_),
                              is_low_ ? &farthest_ : nullptr);
      end_ = spans_.get();
    }

    ZBufferAlgorithm& algorithm_;
    RowRange rows_;
    bool is_low_;
    HierarchicalDepth<Depth> farthest_;
    std::vector<TaggedTriangle> triangles_;
    std::unique_ptr<TaggedSpan[]> spans_;  // not initialized: they are written before they are read
    TaggedSpan* end_;                      // of the queue, which begins with the first
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
  Coverage coverage_;
  RowRange rows_;  // the rows that are drawn
  ZBuffer<Depth> buffer_;
};

}  // namespace pipeline
