#include "tools/zbuf/drawing_report.h"

#include <algorithm>

#include "libpipeline/picture/supersampling.h"
#include "tools/rim/empty_picture_note.h"

namespace pipeline {

DrawingReport::DrawingReport(const PixelRules& rules, const Viewport& screen, int sample_count, bool counts)
    : screen_(screen) {
  pictures_.emplace_back(rules, screen);
  if (sample_count > 1) pictures_.emplace_back(rules, sample_screen(screen, sample_count));
  if (counts) counter_.emplace(rules, screen);
}

void DrawingReport::add(const TriangleBatch& p_ndc) {
  for (EmptyPicture& picture : pictures_) picture.add(p_ndc);
  if (counter_) counter_->add(p_ndc);
  if (is_speck_) measure(p_ndc);
}

void DrawingReport::measure(const TriangleBatch& p_ndc) {
  constexpr double kSmall = 1.0 / 40;
  const double width = -screen_.left, height = -screen_.bottom;
  for (const Triangle& triangle : p_ndc.triangles) {
    const BoundingBox box(triangle);
    if (may_be_visible(triangle, box, screen_)) extent_.add(box);
    is_speck_ = extent_.high.x - extent_.low.x <= 2 * width * kSmall &&
                extent_.high.y - extent_.low.y <= 2 * height * kSmall;
    if (!is_speck_) return;
  }
}

std::optional<std::string> DrawingReport::empty_picture_note() const {
  if (!std::ranges::all_of(pictures_, &EmptyPicture::has_no_area)) {
    constexpr int kLeastSide = 40;  // a speck is less than a pixel of smaller pictures
    if (!is_speck_ || std::min(screen_.columns, screen_.rows) < kLeastSide) return std::nullopt;
    return speck_note(extent_, screen_);
  }
  return unseen_note(pictures_.front().triangles(), screen_,
                     std::ranges::all_of(pictures_, &EmptyPicture::is_empty));
}

void DrawingReport::add_to(Statistics& statistics) const {
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

}  // namespace pipeline
