#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/drawing_counts.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/unseen.h"
#include "tools/rim/statistics.h"

namespace pipeline {

/// Watches the triangles of `zbuf` as they are read: whether one shows and, with --stats, the fate of each.
/// It takes them in the order of the stream, so it depends neither on the visibility algorithm nor on
/// threads.
class DrawingReport {
 public:
  DrawingReport(const PixelRules& rules, const Viewport& screen, int sample_count, bool counts);

  /// Takes the next triangles.
  void add(const TriangleBatch& p_ndc);
  /// The reason why the triangles show no area, or hardly any in total; else nullopt.
  [[nodiscard]] std::optional<std::string> empty_picture_note() const;
  /// Adds the counts and extents, if the report counts.
  void add_to(Statistics& statistics) const;

 private:
  void measure(const TriangleBatch& p_ndc);

  Viewport screen_;
  BoundingBox extent_;                  // of the triangles in the window, as long as they are a speck
  bool is_speck_ = true;                // all triangles together, so far
  std::vector<EmptyPicture> pictures_;  // at centers; at samples, if there are several per pixel
  std::optional<DrawingCounter> counter_;
};

}  // namespace pipeline
