#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/stream/thread_pool.h"
#include "libpipeline/visibility/algorithms.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/triangle_drawing.h"
#include "tools/zbuf/triangle_store.h"

namespace pipeline {

/// The visible triangles at the pixel centers and, with several samples a pixel, at the samples.
template <VisibilityAlgorithm Visible>
struct SampledVisible {
  SampledVisible(const Viewport& of_centers, int sample_count, PixelTag background)
      : center_screen(of_centers),
        screen(sample_screen(of_centers, sample_count)),
        centers(of_centers, background) {
    if (sample_count > 1) samples.emplace(screen, background);
  }
  void set_depth_epsilon(double epsilon) {
    centers.set_depth_epsilon(epsilon);
    if (samples) samples->set_depth_epsilon(epsilon);
  }

  Viewport center_screen;
  Viewport screen;  // of the samples; of the centers if there is one sample a pixel
  Visible centers;
  std::optional<Visible> samples;
};

/// Draws batches with the z-buffer, each triangle with its tag of the store.
template <typename Visible>
class SampledDrawing {
 public:
  SampledDrawing(SampledVisible<Visible>& visible, TriangleStore& store, ThreadPool& pool)
      : store_(store), centers_(visible.centers, visible.center_screen, pool) {
    if (visible.samples) samples_.emplace(*visible.samples, visible.screen, pool);
  }

  /// Where to put the next batch.
  [[nodiscard]] TriangleBatch& next_batch() { return centers_.next_batch(); }
  void draw_batch() {
    const auto tag_of = [&store = store_](const TriangleBatch& p_ndc, std::size_t i) {
      return store.tag_of(p_ndc, i);
    };
    if (!samples_) return centers_.draw_batch(tag_of);
    TriangleBatch& batch = samples_->next_batch() = centers_.next_batch();
    tags_.clear();
    for (std::size_t i = 0; i < batch.size(); ++i) tags_.push_back(tag_of(batch, i));
    const auto kept_tag = [this](const TriangleBatch&, std::size_t i) { return tags_[i]; };
    centers_.draw_batch(kept_tag);
    samples_->draw_batch(kept_tag);
  }
  /// Draws the batches still waiting.
  void finish() {
    centers_.finish();
    if (samples_) samples_->finish();
  }

 private:
  TriangleStore& store_;
  TriangleDrawing<Visible> centers_;
  std::optional<TriangleDrawing<Visible>> samples_;
  std::vector<PixelTag> tags_;  // with samples
};

/// Tells of each triangle of a stream whether it is nearer than all before it at any pixel or sample. Under a
/// depth epsilon any other may be left out of the text that `--seen` writes: a fragment that is drawn over
/// one of depth c is nearer than c by more than epsilon, and none before it is.
template <typename CoverageRule, typename Depth>
class NearestSoFar {
 public:
  explicit NearestSoFar(const SampledVisible<ZBufferAlgorithm<CoverageRule, Depth>>& visible) {
    logs_.emplace_back(visible.center_screen);
    if (visible.samples) logs_.emplace_back(visible.screen);
  }

  bool operator()(const ExactTriangle& p_ndc) {
    bool is_nearest = false;
    for (auto& log : logs_)
      log.add(p_ndc, 0, [&](const Fragment& f) { is_nearest |= f.result == DepthTestResult::kept; });
    return is_nearest;
  }

 private:
  std::vector<FragmentLog<CoverageRule, Depth>> logs_;
};

}  // namespace pipeline
