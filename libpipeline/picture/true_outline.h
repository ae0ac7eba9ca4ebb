#pragma once

#include <array>
#include <cmath>

#include "libpipeline/scene/camera.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/bounds.h"

namespace pipeline {

/// A linear function of a column and a row.
template <typename Number>
struct Linear {
  Number u, v, constant;
};

/// A side of a triangle, as the rows see it: it crosses the centers of a row at the column (v * row +
/// constant) * columns_per_value, not rounded. Relative to that, the columns that a center has to be between
/// if it may be covered, and if it surely is.
template <typename Number>
struct Side {
  Number v, constant, columns_per_value;
  std::array<Number, 2> low, high;
};

/// Where a triangle may be, and where it surely is. Depths are distances in front of the eye for ortho and
/// -1 / distance in perspective, and so linear on the screen.
template <typename Number>
struct TrueOutline {
  /// The pixels around it. In what follows, columns and rows are counted from the first of these.
  Number first_column, end_column, first_row, end_row;
  Number least, greatest;  // depths
  std::array<Side<Number>, 3> sides;
  Linear<Number> nearest, farthest;  // depths at a center, if between `least` and `greatest`
};

/// How the true triangles of a projected text with bounds are seen (true_outline_lanes.h).
struct TrueView {
  /// The window of an axis: cells of the size `step` from `first`, and how far the centers calculated so may
  /// be from the true ones; and clip = scale * view + center * distance.
  struct Axis {
    double first, step, per_step, error, scale, view_per_clip, center;
    RowRange cells;
  };

  /// `projected` is the header's, a Frustum or an Orthographic, and `error` has both of its parts.
  TrueView(const Viewport& screen, const Bounds& error, const Projection& projected);

  /// What the depth lies between at which that of NDC is `z`.
  [[nodiscard]] std::array<double, 2> depths_at(double z) const;
  /// The depth of the near plane.
  [[nodiscard]] double near_depth() const { return is_perspective ? -1 / near : near; }

  /// More than sums of a few doubles lose, as a part of the sum of their absolute values.
  static constexpr double kLost = 0x1p-49;
  static constexpr double kUp = 1 + 0x1p-40;

  Bounds bounds;
  bool is_perspective;
  double near = 0, far = 0;
  double nearest_shown = 0;  // in perspective, a pixel shows no true point that is nearer
  std::array<Axis, 2> axes = {};
};

}  // namespace pipeline
