#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/picture/supersampling.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/drawing_counts.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/unseen.h"
#include "tools/rim/empty_picture_note.h"
#include "tools/rim/statistics.h"

namespace pipeline {

/// Watches the triangles of `zbuf` as they are read: whether one shows and, with --stats, the fate of each.
/// It takes them in the order of the stream, so it depends neither on the visibility algorithm nor on
/// threads.
class DrawingReport {
 public:
  DrawingReport(const PixelRules& rules, const Viewport& screen, int sample_count, bool counts)
      : screen_(screen) {
    pictures_.emplace_back(rules, screen);
    if (sample_count > 1) pictures_.emplace_back(rules, sample_screen(screen, sample_count));
    if (counts) counter_.emplace(rules, screen);
  }

  /// Takes the next triangles.
  void add(const TriangleBatch& p_ndc) {
    for (EmptyPicture& picture : pictures_) picture.add(p_ndc);
    if (counter_) counter_->add(p_ndc);
    for (std::size_t i = 0; i < p_ndc.size() && is_speck_; ++i) measure(p_ndc.triangles[i]);
  }
  /// The reason why the triangles show no area, or hardly any in total; else nullopt.
  [[nodiscard]] std::optional<std::string> empty_picture_note() const {
    if (std::ranges::all_of(pictures_, &EmptyPicture::has_no_area))
      return unseen_note(pictures_.front().triangles(), screen_,
                         std::ranges::all_of(pictures_, &EmptyPicture::is_empty));
    constexpr int kLeastSide = 40;  // a speck is less than a pixel of smaller pictures
    if (!is_speck_ || std::min(screen_.columns, screen_.rows) < kLeastSide) return std::nullopt;
    return speck_note(extent_, screen_);
  }
  /// Adds the counts and extents, if the report counts.
  void add_to(Statistics& statistics) const {
    if (!counter_) return;
    const DrawingCounts counts = counter_->counts();
    statistics.add("triangles", counts.triangles);
    statistics.add(counts.unseen, true);
    if (screen_.drawn_row_count() < screen_.rows) statistics.add("outside_rows", counts.outside_rows);
    statistics.add("hidden", counts.hidden);
    statistics.add("seen", counts.seen);
    statistics.add("pixels_written", counts.pixels_written);
    statistics.add("fragments_tested", counts.fragments_tested);
    statistics.add(counts.extent);
  }

 private:
  void measure(const Triangle& triangle) {
    constexpr double kSmall = 1.0 / 40;
    const BoundingBox box(triangle);
    if (may_be_visible(triangle, box, screen_)) extent_.add(box);
    is_speck_ = extent_.high.x - extent_.low.x <= -2 * screen_.left * kSmall &&
                extent_.high.y - extent_.low.y <= -2 * screen_.bottom * kSmall;
  }

  Viewport screen_;
  BoundingBox extent_;                  // of the triangles in the window, as long as they are a speck
  bool is_speck_ = true;                // all triangles together, so far
  std::vector<EmptyPicture> pictures_;  // at centers; at samples, if there are several per pixel
  std::optional<DrawingCounter> counter_;
};

}  // namespace pipeline
