#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/band_drawing.h"
#include "libpipeline/visibility/tagged_batch.h"

namespace pipeline {

/// Draws the triangles of a stream on the threads of a pool, batch by batch. The result is the
/// same as drawing the triangles one after the other, whatever the number of threads. `Visible` is as for
/// BandDrawing.
///
/// On one thread, batches of small triangles are drawn at once: their pixels are scattered over the picture
/// anyway, and the triangles themselves are still in the cache. All others are drawn in bands.
template <typename Visible>
class TriangleDrawing {
 public:
  /// The pool may do other work, too.
  TriangleDrawing(Visible& visible, const Viewport& screen, ThreadPool& pool)
      : grid_(screen), bands_(visible, screen, pool) {
    if (pool.size() == 1) picture_.emplace(visible, screen.drawn_rows());
  }

  /// Where to put the next batch, with a tag for each triangle.
  [[nodiscard]] TaggedBatch& next() { return next_; }
  /// Draws that batch now or later, at the latest in finish().
  void draw_next() {
    assert(next_.tags.size() == next_.batch.size());
    if (!picture_ || !has_small_triangles(next_.batch)) return bands_.draw(next_);
    bands_.finish();
    for (std::size_t i = 0; i < next_.batch.size(); ++i)
      picture_->draw(exact_triangle(next_.batch, i), next_.tags[i]);
    picture_->finish();
  }
  /// Draws the batches still waiting.
  void finish() { bands_.finish(); }

 private:
  /// Decides by every eighth triangle.
  [[nodiscard]] bool has_small_triangles(const TriangleBatch& batch) const {
    constexpr double kSmall = 32;  // width and height together, in pixels
    constexpr std::size_t kStep = 8;
    double width = 0, height = 0, count = 0;
    for (std::size_t i = 0; i < batch.size(); i += kStep, ++count) {
      const Triangle& p = batch.triangles[i];
      width += std::max({p[0].x, p[1].x, p[2].x}) - std::min({p[0].x, p[1].x, p[2].x});
      height += std::max({p[0].y, p[1].y, p[2].y}) - std::min({p[0].y, p[1].y, p[2].y});
    }
    return width / grid_.dx + height / grid_.dy < kSmall * count;
  }

  PixelGrid grid_;
  TaggedBatch next_;
  std::optional<typename Visible::Drawer> picture_;  // on one thread: for batches drawn at once
  BandDrawing<Visible> bands_;
};

}  // namespace pipeline
