#pragma once

#include <optional>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/pixel_grid.h"

namespace pipeline {

/// The depths of a triangle's plane, calculated with 106 bits, at pixel centers that are not rounded: for
/// triangles so steep or so narrow that doubles lose digits. Bound: tests/proofs/depth_in_pairs.g.
class DepthInPairs {
 public:
  /// The triangle must not be seen edge-on.
  DepthInPairs(const PixelGrid& grid, const Triangle& p_ndc);

  /// The depth along a row; none beyond a double's range. Like TriangleDepth's it is given from the middle,
  /// in half columns: both are whole numbers.
  [[nodiscard]] std::optional<SpanDepth> along(int row, int first_column, int last_column) const;

 private:
  double half_width_;
  double half_height_;
  int columns_;
  int rows_;
  Vec3 origin_;              // a vertex
  DoubleDouble slope_;       // dz/dx
  DoubleDouble slope_in_y_;  // dz/dy
  double half_slope_;        // per half column
};

}  // namespace pipeline
