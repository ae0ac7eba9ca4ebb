#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/visibility/colored_batch.h"
#include "libpipeline/visibility/draw_order.h"
#include "libpipeline/visibility/row_bands.h"

namespace pipeline {

/// Draws batches side by side: every thread has a layer of its own, as large as the picture, and draws the
/// next batch into it as a whole, while the caller reads on. In the end the layers are laid on one another.
/// Each pixel keeps the number of its batch, so that of equal depths the one drawn first stays whichever
/// layers they are in, and the result does not depend on the number of threads. For small triangles, which
/// cost less than sorting them, if there are many: making a layer and laying it on another costs as much as
/// drawing a triangle for every fifteen pixels. What was laid together stays in the layers, where it hides
/// what will be hidden anyway.
///
/// `Visible` is what BandDrawing asks for, made from a screen, and has take_nearer(layer, rows) and
/// forget_order(rows), which a ZBuffer explains.
///
/// Source: "sort-last" in S. Molnar, M. Cox, D. Ellsworth, H. Fuchs, "A sorting classification of parallel
/// rendering", 1994.
template <typename Visible>
class LayerDrawing {
 public:
  /// `visible` is the first layer. The pool may have other work besides.
  LayerDrawing(Visible& visible, const Viewport& screen, ThreadPool& pool)
      : first_(visible), screen_(screen), bands_(screen), pool_(pool) {}
  ~LayerDrawing() { pool_.cancel(); }
  LayerDrawing(const LayerDrawing&) = delete;
  LayerDrawing& operator=(const LayerDrawing&) = delete;

  /// Takes the batch, in exchange for another one's memory. It may be drawn later, at the latest in finish().
  /// Its colors are 0x00RRGGBB. Layers are laid together after kMaxOrders batches, however small.
  void draw(ColoredBatch& batch) {
    if (layers_.empty()) make_layers();
    Slot& slot = slots_[last_order_ % kSlots];
    while (!slot.is_free) pool_.run_one();
    std::swap(slot.drawn, batch);
    slot.order = ++last_order_;
    slot.is_free = false;
    pool_.start(
        1, [this, &slot](int, int worker) { draw_into(layers_[static_cast<std::size_t>(worker)], slot); });
    if (last_order_ == kMaxOrders) finish();
  }
  /// Draws all that is not drawn yet, and lays the layers together in the first.
  void finish() {
    if (last_order_ == 0) return;
    pool_.finish();
    pool_.start(bands_.count(), [this](int band, int) { lay_together(bands_.rows(band)); });
    pool_.finish();
    last_order_ = 0;
  }

 private:
  static constexpr std::size_t kSlots = 8;

  /// Where a batch waits for a thread.
  struct Slot {
    ColoredBatch drawn;
    std::uint32_t order = 0;
    std::atomic<bool> is_free = true;
  };
  using Layer = typename Visible::Band;  // of all rows

  void make_layers() {
    const RowRange all_rows = {0, screen_.rows};
    layers_.emplace_back(first_, all_rows);
    for (int i = 1; i < pool_.size(); ++i) layers_.emplace_back(others_.emplace_back(screen_), all_rows);
  }
  static void draw_into(Layer& layer, Slot& slot) {
    const ColoredBatch& drawn = slot.drawn;
    for (std::size_t i = 0; i < drawn.batch.size(); ++i)
      layer.draw(exact_triangle(drawn.batch, i), with_order(drawn.colors[i], slot.order));
    layer.finish();
    slot.is_free = true;
  }
  void lay_together(const RowRange& rows) {
    for (Visible& other : others_) first_.take_nearer(other, rows);
    first_.forget_order(rows);
  }

  Visible& first_;
  std::deque<Visible> others_;
  std::deque<Layer> layers_;  // each thread's
  std::array<Slot, kSlots> slots_;
  std::uint32_t last_order_ = 0;
  Viewport screen_;
  RowBands bands_;
  ThreadPool& pool_;
};

}  // namespace pipeline
