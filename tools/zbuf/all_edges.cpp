#include "tools/zbuf/all_edges.h"

#include <algorithm>

#include "libpipeline/visibility/tagged_batch.h"

namespace pipeline {

AllEdges::AllEdges(const PixelRules& rules, const Viewport& screen)
    : grid_(screen),
      coverage_(rules, screen),
      test_(rules, screen),
      seen_(screen.drawn_rows(), screen.columns, {test_.nothing().depth, KeptIds::kNoTriangle}),
      ids_(static_cast<std::size_t>(screen.columns)) {}

void AllEdges::add(const TriangleBatch& p_ndc, std::size_t index, PixelTag id, const Wireframe& edges) {
  draw_last(edges);
  last_id_ = id;
  coverage_.visit([&](const auto& rule) {
    for_each_span(rule.rows(exact_triangle(p_ndc, index)), seen_.row_range(),
                  [&](const Span& span) { last_.push_back(span); });
  });
}

std::span<const PixelTag> AllEdges::row(int row, const Wireframe& edges) {
  draw_last(edges);
  std::ranges::transform(seen_.row(row), ids_.begin(), id_of);
  return ids_;
}

void AllEdges::draw_last(const Wireframe& edges) {
  for (const Span& span : last_) {
    const double y = grid_.y_of(span.row);
    const std::span<FragmentTest::Seen> row = seen_.row(span.row);
    for (int column = span.first_column; column <= span.last_column; ++column)
      if (Wireframe::is_on_edge(edges.edges(last_id_), grid_.x_of(column), y))
        test_.judge(row[static_cast<std::size_t>(column)], {column, span.row}, last_id_, span.depth(column));
  }
  last_.clear();
}

}  // namespace pipeline
