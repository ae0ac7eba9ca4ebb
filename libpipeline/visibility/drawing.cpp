#include "libpipeline/visibility/drawing.h"

#include <variant>

#include "libpipeline/visibility/algorithms.h"
#include "libpipeline/visibility/scanline.h"
#include "libpipeline/visibility/triangle_drawing.h"

namespace pipeline {

std::unique_ptr<Drawing> drawing(Algorithm algorithm, const PixelRules& rules, const Viewport& screen,
                                 PixelTag background, ThreadPool& pool) {
  return std::visit(
      [&]<typename Rule, typename Depth>(TypeValue<Rule>, TypeValue<Depth>) -> std::unique_ptr<Drawing> {
        if (algorithm == Algorithm::scanline)
          return std::make_unique<Scanline<Rule, Depth>>(screen, background);
        using ByZBuffer = TriangleDrawing<ZBufferAlgorithm<Rule, Depth>>;
        auto by_z_buffer = std::make_unique<ByZBuffer>(screen, background, pool);
        by_z_buffer->visible().set_depth_epsilon(rules.depth_epsilon);
        return by_z_buffer;
      },
      rules.coverage, rules.depth);
}

}  // namespace pipeline
