#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "libpipeline/scene/camera.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/bounds.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// A function of the place (u, v), relative to a pixel's center.
struct Linear {
  double u = 0, v = 0, constant = 0;
  double u_error = 0, v_error = 0;  // of u and v
  double error = 0;                 // of the value, everywhere in an outline

  [[nodiscard]] double at(double at_u, double at_v) const { return u * at_u + (v * at_v + constant); }
};

/// A bound of the form fixed + per_w * w on a weighted mean of errors.
struct FixedAndPerW {
  double fixed = 0, per_w = 0;
};

/// Where a triangle may be, and where it surely is, relative to the center of a pixel.
struct TrueOutline {
  RowRange columns, rows;
  int column = 0, row = 0;  // of the pixel
  // At a center that may be covered none of these is below 0; where all are above 0, it surely is.
  std::array<Linear, 6> possible;
  std::size_t possible_count = 0;
  std::array<Linear, 3> sure;
  bool may_be_sure = false;
  // The distance is top / bottom, within their errors, and between low and high; then it is widened.
  Linear top, bottom;
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  FixedAndPerW widening;
  double nearest = -std::numeric_limits<double>::infinity();  // the least distance at any pixel

  /// The least and the greatest distance in front of the eye at a place that the triangle covers.
  [[nodiscard]] std::pair<double, double> distances(double at_u, double at_v) const;
  /// The same where that of the text is between these.
  [[nodiscard]] std::pair<double, double> widened(double least, double greatest) const;
};

/// Where the true triangles of a projected text with bounds may be, and where they surely are.
class TrueOutlines {
 public:
  /// `projected` is the header's, a Frustum or an Orthographic, and `bounds` has both of its parts.
  TrueOutlines(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// That of a triangle or, for a piece, of the triangle that it was cut from.
  [[nodiscard]] TrueOutline of(const TriangleBatch& p_ndc, std::size_t index) const;
  /// What the distance in front of the eye at which the depth in NDC is `depth` lies between; infinite beyond
  /// the depth of infinity.
  [[nodiscard]] std::pair<double, double> distance_at(double depth) const;
  [[nodiscard]] double near() const { return near_; }
  /// From one column, or row, to the next in NDC.
  [[nodiscard]] double step(std::size_t axis) const { return axes_[axis].step; }

 private:
  struct Vertex;
  struct Seen;
  struct Edges;
  /// The window of an axis: cells of the size `step` from `first`, and how far the centers calculated so may
  /// be from the true ones; and clip = scale * view + center * distance.
  struct Axis {
    double first, step, error, scale, center;

    [[nodiscard]] double from_center(double at) const;
  };

  [[nodiscard]] std::array<Vertex, 3> vertices_of(const TriangleBatch& p_ndc, std::size_t index) const;
  void set_cells(TrueOutline& outline, const std::array<Vertex, 3>& vertices) const;
  [[nodiscard]] Seen seen_from_middle(const std::array<Vertex, 3>& vertices,
                                      const TrueOutline& outline) const;

  Viewport screen_;
  Bounds bounds_;
  bool is_perspective_;
  double near_ = 0, far_ = 0;
  double nearest_shown_ = 0;  // in perspective, a pixel shows no true point that is nearer
  std::array<Axis, 2> axes_ = {};
};

}  // namespace pipeline
