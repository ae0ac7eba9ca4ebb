#include "libpipeline/raytracing/exact_fragment.h"

namespace pipeline {

ExactFragments::ExactFragments(const TracedTriangles& triangles, const ProjectionTransform& projection,
                               const ExactGrid& grid)
    : triangles_(triangles), grid_(grid), projection_(projection, "", false), cache_(kCached) {}

const CenterRows& ExactFragments::rows_of(TracedTriangles::Id id) {
  CachedRows& cached = cache_[id % kCached];
  if (cached.id == id) return *cached.rows;
  p_view_.clear();
  p_view_.add(triangles_.p_view(id), 0, {});
  const TriangleBatch& p_ndc = projection_.project(p_view_);
  const std::size_t piece = triangles_.piece(id).value_or(0);
  cached.id = id;
  cached.rows.emplace(grid_, ExactTriangle{p_ndc.triangles[piece],
                                           p_ndc.low_parts.empty() ? nullptr : &p_ndc.low_parts[piece],
                                           p_ndc.decimal_marks[piece]});
  return *cached.rows;
}

std::optional<double> ExactFragments::depth(TracedTriangles::Id id, int row, int column) {
  ++count_;
  const CenterRows& rows = rows_of(id);
  if (row < rows.first_row() || row > rows.last_row()) return std::nullopt;
  const std::optional<Span> span = rows.span(row);
  if (!span || column < span->first_column || column > span->last_column) return std::nullopt;
  return span->depth(column);
}

}  // namespace pipeline
