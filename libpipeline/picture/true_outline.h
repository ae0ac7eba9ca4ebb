#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "libpipeline/scene/camera.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/bounds.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// A linear function of a column and a row.
struct Linear {
  double u = 0, v = 0, constant = 0;
};

/// A side of a triangle, as the rows see it: relative to the column where it crosses the centers of a row,
/// not rounded, the columns that a center has to be between if it may be covered, and if it surely is.
struct Side {
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  [[nodiscard]] double crossing(int row) const { return (v * row + constant) * columns_per_value; }

  double v = 0, constant = 0, columns_per_value = 0;
  std::array<double, 2> low = {-kFar, kFar}, high = {kFar, -kFar};
};

/// A triangle's vertices in clip space, and how far each may be from the true one.
struct UncertainVertices {
  std::array<std::array<double, 3>, 2> p;         // x and y
  std::array<double, 3> w, distance;              // in front of the eye: w, but for ortho, where w is 1
  std::array<double, 2> least_ndc, greatest_ndc;  // x and y
  double least_w, greatest_w, largest_w;          // the last of |w|
  double nearest, farthest;                       // distances
  double nearest_shown;                           // w of what a pixel may show
  double error, w_error, depth_error;             // of each coordinate in view space, w and the distance
  double own, own_per_w;                          // of x and y by the projection's own rounding
  bool is_whole;                                  // before it was cut
};

/// Where a triangle may be, and where it surely is. Depths are distances in front of the eye for ortho and
/// -1 / distance in perspective, and so linear on the screen.
struct TrueOutline {
  /// The pixels around it. In what follows, columns and rows are counted from the first of these.
  RowRange columns, rows;
  double least, greatest;  // depths
  std::array<Side, 3> sides;
  Linear nearest, farthest;  // depths at a center, if between `least` and `greatest`
  UncertainVertices vertices;

  [[nodiscard]] bool is_empty() const { return columns.first >= columns.end || rows.first >= rows.end; }
};

/// Where the true triangles of a projected text with bounds may be, and where they surely are.
class TrueOutlines {
 public:
  /// `projected` is the header's, a Frustum or an Orthographic, and `bounds` has both of its parts.
  TrueOutlines(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// Sets the box and the range of depths of a triangle or, for a piece, of the triangle that it was cut
  /// from.
  void set_box(TrueOutline& outline, const TriangleBatch& p_ndc, std::size_t index) const;
  /// Sets the rest, unless the box is empty; it may turn out so.
  void set_sides(TrueOutline& outline) const;
  /// What the depth lies between at which that of NDC is `z`.
  [[nodiscard]] std::array<double, 2> depths_at(double z) const;
  /// The depth of the near plane.
  [[nodiscard]] double near_depth() const { return is_perspective_ ? -1 / near_ : near_; }

 private:
  struct Seen;
  /// The window of an axis: cells of the size `step` from `first`, and how far the centers calculated so may
  /// be from the true ones; and clip = scale * view + center * distance.
  struct Axis {
    double first, step, per_step, error, scale, view_per_clip, center;
    RowRange cells;

    [[nodiscard]] double at(int cell) const { return first + cell * step; }
    [[nodiscard]] double from_center(double low, double high) const;
  };

  void set_vertices(UncertainVertices& vertices, const TriangleBatch& p_ndc, std::size_t index) const;
  void set_errors(UncertainVertices& vertices, double largest_rounded) const;
  [[nodiscard]] RowRange cells_of(std::size_t axis, const UncertainVertices& vertices) const;
  [[nodiscard]] Seen seen_from_first(const TrueOutline& outline) const;
  void set_depths(TrueOutline& outline, const Seen& seen, double most_per_w) const;

  Bounds bounds_;
  bool is_perspective_;
  double near_ = 0, far_ = 0;
  double nearest_shown_ = 0;  // in perspective, a pixel shows no true point that is nearer
  std::array<Axis, 2> axes_ = {};
};

}  // namespace pipeline
