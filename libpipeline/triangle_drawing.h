#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "libpipeline/band_drawing.h"
#include "libpipeline/colored_batch.h"
#include "libpipeline/config.h"
#include "libpipeline/exact_grid.h"
#include "libpipeline/pixel_grid.h"
#include "libpipeline/span.h"
#include "libpipeline/triangle_batch.h"
#include "libpipeline/worker_team.h"

namespace pipeline {

/// Draws the triangles of a stream on the threads it is given, batch by batch, each in the way that suits its
/// triangles. What is seen in the end does not depend on the number of threads: it is what the triangles give
/// one after the other. `Visible` is what BandDrawing asks for.
///
/// On one thread, small triangles are drawn at once: their pixels are somewhere else anyway, and they
/// themselves are still in the cache.
template <typename Visible>
class TriangleDrawing {
 public:
  TriangleDrawing(Visible& visible, const ScreenConfig& screen, int thread_count)
      : grid_(screen), bands_(visible, screen, team_), team_(thread_count) {
    if (thread_count == 1) whole_.emplace(visible, RowRange{0, screen.rows});
  }

  /// Where the next batch is to be put.
  [[nodiscard]] TriangleBatch& next_batch() { return next_.batch; }
  /// Takes what was put there, each triangle in the colour `color_of(batch, index)`, which is asked for at
  /// once and in order. It may be drawn later, at the latest in finish().
  template <typename ColorOf>
  void draw_batch(ColorOf&& color_of) {
    next_.colors.clear();
    for (std::size_t i = 0; i < next_.batch.size(); ++i) next_.colors.push_back(color_of(next_.batch, i));
    if (whole_ && has_small_triangles(next_.batch))
      draw_at_once();
    else
      bands_.draw(next_);
  }
  /// Draws all that is not drawn yet.
  void finish() { bands_.finish(); }

 private:
  /// By some of them.
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

  void draw_at_once() {
    bands_.finish();
    for (std::size_t i = 0; i < next_.batch.size(); ++i)
      whole_->draw(exact_triangle(next_.batch, i), next_.colors[i]);
    whole_->finish();
  }

  PixelGrid grid_;
  ColoredBatch next_;
  std::optional<typename Visible::Band> whole_;  // on one thread: for what is drawn at once
  BandDrawing<Visible> bands_;
  WorkerTeam team_;  // the last: its threads end before what they use
};

}  // namespace pipeline
