#pragma once

#include <optional>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/double_double.h"

namespace pipeline {

/// The plane of a triangle whose coordinates are not all decimals, for its depths under the rule `center`. It
/// is calculated in pairs of doubles, which lose nothing that the depth's bound would show
/// (tests/proofs/depth_in_planes.g).
struct DepthPlane {
  DoubleDouble corner;  // the depth at the center of the pixel in row 0 and column 0
  DoubleDouble per_column;
  DoubleDouble per_row;
};

/// The triangle's plane; none where that bound is not certain: for the narrowest triangles, extreme numbers,
/// and windows whose limits have many digits.
std::optional<DepthPlane> depth_plane(const ExactGrid& grid, const ExactTriangle& triangle);

/// The depth along a row of the triangle, as TriangleDepth::along().
SpanDepth depth_along(const DepthPlane& plane, int row, int first_column, int last_column);

}  // namespace pipeline
