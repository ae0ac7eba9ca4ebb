#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/raytracing/traced_triangles.h"

namespace pipeline {

/// Asks the coverage rule `center` and its depth for single pixels, as `zbuf` does for the text that
/// `project --digits exact` writes. For one thread.
class ExactFragments {
 public:
  ExactFragments(const TracedTriangles& triangles, const ProjectionTransform& projection,
                 const ExactGrid& grid);

  /// The depth of a triangle at a pixel; none if it does not cover the pixel's center.
  [[nodiscard]] std::optional<double> depth(TracedTriangles::Id id, int row, int column);
  /// How often it was asked.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  // Neighboring pixels show the same few triangles.
  static constexpr std::size_t kCached = 256;
  struct CachedRows {
    std::optional<TracedTriangles::Id> id;
    std::optional<CenterRows> rows;
  };

  const CenterRows& rows_of(TracedTriangles::Id id);

  const TracedTriangles& triangles_;
  const ExactGrid& grid_;
  ExactProjection projection_;
  TriangleBatch p_view_;
  std::vector<CachedRows> cache_;
  std::uint64_t count_ = 0;
};

}  // namespace pipeline
