#pragma once

#include <concepts>

#include "libpipeline/color.h"
#include "libpipeline/config.h"
#include "libpipeline/exact_grid.h"
#include "libpipeline/scanline.h"
#include "libpipeline/span.h"
#include "libpipeline/visible_row.h"
#include "libpipeline/zbuffer.h"

namespace pipeline {

/// A visibility algorithm takes the triangles of the stream one by one, and then answers, row by row, which
/// of them is seen where and how deep: the one with the smallest depth between the limits, as the depth
/// format stores it, of equal ones the earliest. So the answer does not depend on the algorithm. Each is a
/// class template of a coverage rule and a depth format, whose objects are made from the screen.
template <typename Algorithm>
concept VisibilityAlgorithm = std::constructible_from<Algorithm, const ScreenConfig&> &&
    requires(Algorithm& algorithm, const Algorithm& complete, const ExactTriangle& triangle, Color color) {
  algorithm.draw(triangle, color);
  complete.for_each_row([](const VisibleRow&) {});
};

/// The z-buffer: draws a triangle as soon as it comes, as a whole or the part in some rows; threads may draw
/// into different rows at the same time.
template <typename Coverage, typename Depth>
class ZBufferAlgorithm {
 public:
  explicit ZBufferAlgorithm(const ScreenConfig& screen, Color background = {})
      : coverage_(screen), buffer_(screen, background) {}

  /// From now on a fragment has to be nearer than the last by more than `epsilon`.
  void set_depth_epsilon(double epsilon) { buffer_.set_depth_epsilon(epsilon); }
  void draw(const ExactTriangle& triangle, Color color) {
    for_each_span(coverage_.rows(triangle), [&](const Span& span) { buffer_.draw(span, color); });
  }
  /// What draws into some rows, triangle by triangle; nothing else may while it is in use.
  class Band {
   public:
    Band(ZBufferAlgorithm& whole, const RowRange& rows)
        : whole_(whole), rows_(rows), farthest_(whole.buffer_.farthest_depths(rows)) {}
    void draw(const ExactTriangle& triangle, Color color) {
      for_each_span(whole_.coverage_.rows(triangle), rows_,
                    [&](const Span& span) { whole_.buffer_.draw(span, color, &farthest_); });
    }

   private:
    ZBufferAlgorithm& whole_;
    RowRange rows_;
    FarthestDepths<Depth> farthest_;
  };

  template <typename Visitor>
  void for_each_row(Visitor&& visit) const {
    buffer_.for_each_row(visit);
  }

 private:
  Coverage coverage_;
  ZBuffer<Depth> buffer_;
};

/// The scan-line algorithm: keeps the triangles until it is asked.
template <typename Coverage, typename Depth>
using ScanlineAlgorithm = Scanline<Coverage, Depth>;

}  // namespace pipeline
