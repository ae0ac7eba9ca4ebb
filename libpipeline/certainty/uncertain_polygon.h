#pragma once

#include <array>
#include <cstddef>

#include "libpipeline/scene/camera.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/bounds.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The visible part of a triangle on the screen, in doubles, and how far the true one may be from it.
///
/// Each true point that can be seen belongs to a point of the polygon, and each point of the polygon to a
/// true one, at most `columns_off` and `rows_off` away; neighbors belong to neighbors. A depth may be off by
/// `depth_off`: by the absolute part, and by a factor of at most 1 + the relative one.
struct UncertainPolygon {
  /// In pixels, whose centers are at whole columns and rows; a depth that is linear on the screen.
  struct Point {
    double column, row, depth;
  };
  /// A triangle that is cut at five planes has 8, and never more than half as many again after each cut.
  static constexpr std::size_t kMaxPoints = 20;

  std::array<Point, kMaxPoints> points;
  std::size_t count = 0;     // of the points; if 0, no true point can be seen
  bool is_anywhere = false;  // the true triangle may be anywhere, so there are no points
  double columns_off = 0, rows_off = 0;
  double rounding = 0;        // the part of both that the points have by rounding
  ErrorBound depth_off = {};  // if it has a relative part, depths are below 0
};

/// The window onto a projected text with bounds. Depths are distances in front of the eye for an orthographic
/// projection, and -1 / distance in perspective.
class UncertainView {
 public:
  /// `projected` is the header's, a Frustum or an Orthographic, and `bounds` has both of its parts.
  UncertainView(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// The triangle of this index, for a piece the triangle that it was cut from.
  [[nodiscard]] UncertainPolygon polygon(const TriangleBatch& p_ndc, std::size_t index) const;
  /// Bounds on the depth of an NDC depth.
  [[nodiscard]] std::array<double, 2> depths_at(double z) const;
  /// The depth of the near plane.
  [[nodiscard]] double near_depth() const { return is_perspective_ ? -1 / near_ : near_; }

 private:
  struct Vertices;
  struct ClipPolygon;
  /// An axis of the window: the first pixel's center in NDC, pixels per NDC, their count, the ends of the
  /// window with one pixel more; clip space is `scale` * view space + `center` * w.
  struct Axis {
    double first, per_step, cell_count, low, high, scale, center;
  };

  [[nodiscard]] Vertices vertices(const TriangleBatch& p_ndc, std::size_t index) const;
  [[nodiscard]] bool cut(ClipPolygon& polygon, const Vertices& vertices) const;
  [[nodiscard]] UncertainPolygon on_screen(const ClipPolygon& polygon, const Vertices& vertices) const;

  Bounds bounds_;
  bool is_perspective_;
  double near_ = 0, far_ = 0;
  double least_shown_w_ = 0;  // in perspective, no true point with less w can be seen
  std::array<Axis, 2> axes_ = {};
};

}  // namespace pipeline
