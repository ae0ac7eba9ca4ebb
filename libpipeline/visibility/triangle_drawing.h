#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/band_drawing.h"
#include "libpipeline/visibility/colored_batch.h"
#include "libpipeline/visibility/draw_order.h"
#include "libpipeline/visibility/layer_drawing.h"
#include "libpipeline/visibility/row_bands.h"

namespace pipeline {

/// What the colors of triangles are: colors 0x00RRGGBB, or whatever has 32 bits.
enum class ColorUse { rgb, id };

/// Draws the triangles of a stream on the threads of a pool, batch by batch, each in the way that suits its
/// triangles. What is seen in the end does not depend on the number of threads: it is what the triangles give
/// one after the other. `Visible` is what BandDrawing and LayerDrawing ask for, and has needs_no_order().
///
/// Large triangles are drawn in bands. On one thread, small ones are drawn at once: their pixels are
/// somewhere else anyway, and they themselves are still in the cache. On several threads they are drawn in
/// layers, if the layers are not large and the triangles many.
template <typename Visible>
class TriangleDrawing {
 public:
  /// The pool may have other work besides.
  TriangleDrawing(Visible& visible, const Viewport& screen, ThreadPool& pool, ColorUse use)
      : visible_(visible),
        grid_(screen),
        may_use_layers_(pool.size() > 1 && use == ColorUse::rgb && layers_fit(screen, pool.size())),
        worth_layers_(static_cast<std::size_t>(screen.rows) * static_cast<std::size_t>(screen.columns) / 8),
        bands_(visible, screen, pool),
        layers_(visible, screen, pool) {
    if (pool.size() == 1) whole_.emplace(visible, RowRange{0, screen.rows});
  }

  /// Where the next batch is to be put.
  [[nodiscard]] TriangleBatch& next_batch() { return next_.batch; }
  /// Takes what was put there, each triangle in the color `color_of(batch, index)`, which is asked for at
  /// once and in order. It may be drawn later, at the latest in finish().
  template <typename ColorOf>
  void draw_batch(ColorOf&& color_of) {
    const bool is_small = has_small_triangles(next_.batch);
    if (whole_ && is_small) return draw_at_once(color_of);
    small_count_ = is_small && has_enough_for_layers(next_.batch) ? small_count_ + next_.batch.size() : 0;
    next_.colors.resize(next_.batch.size());
    for (std::size_t i = 0; i < next_.batch.size(); ++i) next_.colors[i] = color_of(next_.batch, i);
    if (may_use_layers_ && visible_.needs_no_order() && small_count_ > worth_layers_)
      draw_in_layers();
    else
      draw_in_bands();
  }
  /// Draws all that is not drawn yet.
  void finish() {
    bands_.finish();
    layers_.finish();
  }

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

  /// Where the layers beside the first are larger, bands win: their pixels are in a nearer cache.
  static bool layers_fit(const Viewport& screen, int thread_count) {
    constexpr double kMaxBytes = 1 << 23;
    return 1.0 * RowBands::kBytesPerPixel * screen.rows * screen.columns * (thread_count - 1) <= kMaxBytes;
  }
  /// For the time until layers of such batches have to be laid together.
  [[nodiscard]] bool has_enough_for_layers(const TriangleBatch& batch) const {
    return batch.size() * kMaxOrders > worth_layers_;
  }

  void draw_in_layers() {
    bands_.finish();
    layers_.draw(next_);
  }
  void draw_in_bands() {
    layers_.finish();
    bands_.draw(next_);
  }
  template <typename ColorOf>
  void draw_at_once(ColorOf& color_of) {
    bands_.finish();
    for (std::size_t i = 0; i < next_.batch.size(); ++i)
      whole_->draw(exact_triangle(next_.batch, i), color_of(next_.batch, i));
    whole_->finish();
  }

  Visible& visible_;
  PixelGrid grid_;
  bool may_use_layers_;
  std::size_t worth_layers_;  // so many triangles after another are worth them: as many may well follow
  ColoredBatch next_;
  std::size_t small_count_ = 0;                  // of triangles, since the last that are not for layers
  std::optional<typename Visible::Band> whole_;  // on one thread: for what is drawn at once
  BandDrawing<Visible> bands_;
  LayerDrawing<Visible> layers_;
};

}  // namespace pipeline
