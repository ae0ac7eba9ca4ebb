#include "libpipeline/visibility/drawing.h"

#include <variant>

#include "libpipeline/visibility/algorithms.h"
#include "libpipeline/visibility/scanline.h"
#include "libpipeline/visibility/triangle_drawing.h"

namespace pipeline {
namespace {

template <typename Coverage, typename Depth>
class ZBufferDrawing final : public Drawing {
 public:
  ZBufferDrawing(const PixelRules& rules, const Viewport& screen, PixelTag background, ThreadPool& pool)
      : visible_(screen, background), triangles_(visible_, screen, pool) {
    visible_.set_depth_epsilon(rules.depth_epsilon);
  }

  TaggedBatch& next() override { return triangles_.next(); }
  void draw_next() override { triangles_.draw_next(); }
  void finish() override { triangles_.finish(); }

  void for_each_drawn_row(const std::function<void(std::span<PixelTag>)>& visit) override {
    visible_.for_each_drawn_row(visit);
  }
  void for_each_row(const std::function<void(const VisibleRow&)>& visit) const override {
    visible_.for_each_row(visit);
  }

 private:
  using Visible = ZBufferAlgorithm<Coverage, Depth>;

  Visible visible_;
  TriangleDrawing<Visible> triangles_;
};

}  // namespace

std::unique_ptr<Drawing> drawing(Algorithm algorithm, const PixelRules& rules, const Viewport& screen,
                                 PixelTag background, ThreadPool& pool) {
  return std::visit(
      [&]<typename Rule, typename Depth>(TypeValue<Rule>, TypeValue<Depth>) -> std::unique_ptr<Drawing> {
        if (algorithm == Algorithm::scanline)
          return std::make_unique<Scanline<Rule, Depth>>(screen, background);
        return std::make_unique<ZBufferDrawing<Rule, Depth>>(rules, screen, background, pool);
      },
      rules.coverage, rules.depth);
}

}  // namespace pipeline
