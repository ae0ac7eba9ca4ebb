#include "tools/zbuf/all_edges.h"

#include <algorithm>
#include <vector>

#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/raster.h"
#include "libpipeline/visibility/tagged_batch.h"

namespace pipeline {
namespace {

template <typename CoverageRule, typename Depth>
class AllEdgesOf final : public AllEdges {
 public:
  AllEdgesOf(const Viewport& screen, double epsilon)
      : grid_(screen),
        coverage_(screen),
        test_(screen, epsilon),
        seen_(screen.drawn_rows(), screen.columns, {test_.nothing().depth, KeptIds::kNoTriangle}),
        ids_(static_cast<std::size_t>(screen.columns)) {}

  void add(const TriangleBatch& p_ndc, std::size_t index, PixelTag id, const Wireframe& edges) override {
    draw_last(edges);
    last_id_ = id;
    for_each_span(coverage_.rows(exact_triangle(p_ndc, index)), seen_.row_range(),
                  [&](const Span& span) { last_.push_back(span); });
  }

  std::span<const PixelTag> row(int row, const Wireframe& edges) override {
    draw_last(edges);
    std::ranges::transform(seen_.row(row), ids_.begin(), id_of);
    return ids_;
  }

  void for_each_id(const std::function<void(PixelTag&)>& visit) override {
    for (int row = seen_.row_range().first; row < seen_.row_range().end; ++row)
      for (auto& seen : seen_.row(row)) {
        PixelTag id = id_of(seen);
        visit(id);
        seen.triangle = id;
      }
    if (!last_.empty()) visit(last_id_);
  }

 private:
  using Seen = typename FragmentTest<Depth>::Seen;

  static PixelTag id_of(const Seen& seen) { return static_cast<PixelTag>(seen.triangle); }

  void draw_last(const Wireframe& edges) {
    for (const Span& span : last_) {
      const double y = grid_.y_of(span.row);
      const std::span<Seen> row = seen_.row(span.row);
      for (int column = span.first_column; column <= span.last_column; ++column)
        if (Wireframe::is_on_edge(edges.edges(last_id_), grid_.x_of(column), y))
          test_.judge(row[static_cast<std::size_t>(column)], {column, span.row}, last_id_,
                      span.depth(column));
    }
    last_.clear();
  }

  PixelGrid grid_;
  CoverageRule coverage_;
  FragmentTest<Depth> test_;
  Raster<Seen> seen_;
  std::vector<PixelTag> ids_;
  std::vector<Span> last_;  // of the triangle added last
  PixelTag last_id_ = 0;
};

}  // namespace

std::unique_ptr<AllEdges> all_edges(const ZbufOptions& chosen, const Viewport& screen) {
  if (!chosen.has_all_edges || !chosen.has_image()) return nullptr;
  return made_for<AllEdges, AllEdgesOf>(chosen.rules, screen, chosen.rules.depth_epsilon);
}

}  // namespace pipeline
