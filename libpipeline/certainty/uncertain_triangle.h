#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/camera.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/bounds.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The pixels whose centers a true triangle may cover or surely covers, and bounds on its depth there. Depths
/// are distances in front of the eye for an orthographic projection, and -1 / distance in perspective: both
/// are linear on the screen.
struct UncertainTriangle {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  /// x * column + y * row + z, with column and row counted from the first ones.
  using Linear = Vec3;

  /// A center can be covered only if all sides are at least `possible_from` there, and surely is if all are
  /// above `sure_from`.
  struct Side {
    Linear inside;
    double possible_from, sure_from;
  };

  /// A row of the triangle. Columns are counted from the first one.
  struct Row {
    RowRange possible, sure;             // columns; sure ones are also possible
    double nearest_at_0, farthest_at_0;  // bounds at column 0; those on all depths may be tighter
  };

  void add(const Side& side) { sides[side_count++] = side; }
  [[nodiscard]] Row row(int row) const;
  [[nodiscard]] double nearest(const Row& on, int column) const {
    return std::max(on.nearest_at_0 + nearest_plane.x * column, least);
  }
  [[nodiscard]] double farthest(const Row& on, int column) const {
    return std::min(on.farthest_at_0 + farthest_plane.x * column, greatest);
  }

  RowRange columns, rows;  // with all centers that may be covered
  std::array<Side, 5> sides = {};
  std::size_t side_count = 0;
  Linear nearest_plane = {0, 0, -kInfinity}, farthest_plane = {0, 0, kInfinity};
  double least = -kInfinity, greatest = kInfinity;  // bounds on all depths
};

/// The window onto a projected text with bounds.
class UncertainView {
 public:
  /// `projected` comes from the header, a Frustum or an Orthographic; `bounds` has both of its parts.
  UncertainView(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// The visible part of the triangle with this index; for a piece, of the uncut triangle.
  [[nodiscard]] UncertainTriangle triangle(const TriangleBatch& p_ndc, std::size_t index) const;
  /// Bounds on the depth (see UncertainTriangle) of a depth in NDC.
  [[nodiscard]] std::array<double, 2> depths_at(double z) const;

 private:
  struct Corners;
  struct Edges;
  /// An axis of the window: clip space is `scale` * view space + `center` * w.
  struct Axis {
    double Vec3::*of;  // a point's coordinate
    RowRange UncertainTriangle::*range;
    double first, per_ndc;  // the first pixel's center in NDC, pixels per NDC
    int count;              // of pixels
    double scale, center;
  };

  [[nodiscard]] Corners corners(const TriangleBatch& p_ndc, std::size_t index) const;
  double place_on_screen(Corners& corners, double printed_in_clip, double printed_in_ndc) const;
  void set_box(UncertainTriangle& triangle, Corners& corners) const;
  void set_depths(UncertainTriangle& triangle, const Corners& corners, const Edges& edges) const;

  Bounds bounds_;
  bool is_perspective_;
  double near_ = 0, far_ = 0;
  std::array<Axis, 2> axes_ = {};
  double least_shown_w_ = 1;          // no true point with less w can be seen
  std::array<double, 2> front_ = {};  // depths: nearer ones are not seen, and farther ones are never cut
};

}  // namespace pipeline
