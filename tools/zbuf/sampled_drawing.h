#pragma once

#include <functional>
#include <memory>

#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/visibility/drawing.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The visible triangles at the pixel centers and, with several samples per pixel, at the samples.
class SampledDrawing {
 public:
  SampledDrawing(const ZbufOptions& chosen, const Viewport& of_centers, PixelTag background,
                 ThreadPool& pool);

  /// The place for the next batch and its tags.
  [[nodiscard]] TaggedBatch& next() { return centers_->next(); }
  /// Draws this batch, at the latest in finish().
  void draw_next();
  /// Draws the batches still waiting.
  void finish();

  /// Calls `visit` with the tags, which it may change, of every row with something drawn.
  void for_each_drawn_row(const std::function<void(std::span<PixelTag>)>& visit);
  [[nodiscard]] const Drawing& centers() const { return *centers_; }
  /// The drawing at the samples; null if there is one sample per pixel, at its center.
  [[nodiscard]] const Drawing* samples() const { return samples_.get(); }

 private:
  std::unique_ptr<Drawing> centers_, samples_;
};

}  // namespace pipeline
