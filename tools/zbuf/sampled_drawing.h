#pragma once

#include <functional>
#include <memory>
#include <span>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/visibility/drawing.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The visible triangles at the pixel centers and, with several samples per pixel, at the samples.
class SampledDrawing {
 public:
  SampledDrawing(const ZbufOptions& chosen, const Viewport& of_centers, PixelTag background, ThreadPool& pool)
      : centers_(drawing(chosen.algorithm, chosen.rules, of_centers, background, pool)) {
    if (chosen.sample_count == 1) return;
    const Viewport of_samples = sample_screen(of_centers, chosen.sample_count);
    samples_ = drawing(chosen.algorithm, chosen.rules, of_samples, background, pool);
  }

  // As those of Drawing.
  [[nodiscard]] TaggedBatch& next() { return centers_->next(); }
  void draw_next() {
    if (samples_) samples_->next() = centers_->next();
    centers_->draw_next();
    if (samples_) samples_->draw_next();
  }
  void finish() {
    centers_->finish();
    if (samples_) samples_->finish();
  }
  void for_each_drawn_row(const std::function<void(std::span<PixelTag>)>& visit) {
    centers_->for_each_drawn_row(visit);
    if (samples_) samples_->for_each_drawn_row(visit);
  }
  [[nodiscard]] const Drawing& centers() const { return *centers_; }
  /// The drawing at the samples; null if there is one sample per pixel, at its center.
  [[nodiscard]] const Drawing* samples() const { return samples_.get(); }

 private:
  std::unique_ptr<Drawing> centers_, samples_;
};

}  // namespace pipeline
