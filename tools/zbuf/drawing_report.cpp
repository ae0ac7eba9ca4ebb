#include "tools/zbuf/drawing_report.h"

#include "libpipeline/coverage/rules.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/visibility/depth_format.h"
#include "libpipeline/visibility/drawing_counts.h"
#include "libpipeline/visibility/unseen.h"
#include "tools/rim/empty_picture_note.h"

namespace pipeline {
namespace {

template <typename CoverageRule, typename Depth>
class ReportOf final : public DrawingReport {
 public:
  ReportOf(double depth_epsilon, const Viewport& screen, int sample_count, bool counts)
      : screen_(screen), at_centers_(screen) {
    if (sample_count > 1) at_samples_.emplace(sample_screen(screen, sample_count));
    if (counts) counter_.emplace(screen, depth_epsilon);
  }

  void add(const TriangleBatch& p_ndc) override {
    at_centers_.add(p_ndc);
    if (at_samples_) at_samples_->add(p_ndc);
    if (counter_) counter_->add(p_ndc);
  }

  [[nodiscard]] std::optional<std::string> empty_picture_note() const override {
    const bool is_empty = at_centers_.is_empty() && (!at_samples_ || at_samples_->is_empty());
    return is_empty ? std::optional(unseen_note(at_centers_.triangles(), screen_)) : std::nullopt;
  }

  void add_to(Statistics& statistics) const override {
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
  Viewport screen_;
  EmptyPicture<CoverageRule, Depth> at_centers_;
  std::optional<EmptyPicture<CoverageRule, Depth>> at_samples_;
  std::optional<DrawingCounter<CoverageRule, Depth>> counter_;
};

}  // namespace

std::unique_ptr<DrawingReport> drawing_report(const PixelRules& rules, const Viewport& screen,
                                              int sample_count, bool counts) {
  return made_for<DrawingReport, ReportOf>(rules, rules.depth_epsilon, screen, sample_count, counts);
}

}  // namespace pipeline
