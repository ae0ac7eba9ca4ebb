#include "tools/zbuf/sampled_drawing.h"

#include "libpipeline/picture/supersampling.h"

namespace pipeline {

SampledDrawing::SampledDrawing(const ZbufOptions& chosen, const Viewport& of_centers, PixelTag background,
                               ThreadPool& pool)
    : centers_(drawing(chosen.algorithm, chosen.rules, of_centers, background, pool)) {
  if (chosen.sample_count == 1) return;
  const Viewport of_samples = sample_screen(of_centers, chosen.sample_count);
  samples_ = drawing(chosen.algorithm, chosen.rules, of_samples, background, pool);
}

void SampledDrawing::draw_next() {
  if (samples_) samples_->next() = centers_->next();
  centers_->draw_next();
  if (samples_) samples_->draw_next();
}

void SampledDrawing::finish() {
  centers_->finish();
  if (samples_) samples_->finish();
}

void SampledDrawing::for_each_drawn_row(const std::function<void(std::span<PixelTag>)>& visit) {
  centers_->for_each_drawn_row(visit);
  if (samples_) samples_->for_each_drawn_row(visit);
}

}  // namespace pipeline
