#pragma once

#include <array>
#include <optional>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/pixel_grid.h"

namespace pipeline {

/// The coverage rule `nearest` for one triangle in NDC: on every row whose line of pixel centers meets the
/// triangle, the pixels from the one nearest to the left intersection to the one nearest to the right, both
/// included (halfway: the pixel on the right). Neighboring triangles thus both own the pixels on a shared
/// edge, and a triangle that is narrower than a pixel still has one on each row. Horizontal edges do not
/// count; both ends of the others do.
///
/// All arithmetic is in doubles, in a fixed order. Any finite coordinates are allowed, also where differences
/// or products of them are not finite. Source: "Raster Based Graphics Pipeline", CSE 410 offline 2, 2022.
class NearestRows {
 public:
  /// A bound on the error of a triangle's area, relative to the sum of the two products whose difference it
  /// is. Up to that bound, rounding hides whether the triangle is seen edge-on (J. Shewchuk, "Adaptive
  /// precision floating-point arithmetic and fast robust geometric predicates", 1997, ccwerrboundA).
  static constexpr double kAreaError = (3 + 16 * 0x1p-53) * 0x1p-53;

  NearestRows(const PixelGrid& grid, const Triangle& p_ndc);

  /// The rows that may have pixels, inside the screen; first_row() > last_row() if there are none.
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }

  /// The pixels the triangle covers on `row`, inside the screen; none where it has fewer than two
  /// intersections or lies entirely left or right of the screen. The depth is linear through the left
  /// intersection and has the slope of the triangle's plane; where left and right intersection have the same
  /// x, and where the triangle is seen edge-on, the depth is the smaller of the two.
  [[nodiscard]] std::optional<Span> span(int row) const;

 private:
  struct Edge {
    Vec3 lower;  // by y, then x, then z: neighbors get the same point of a shared edge
    Vec3 upper;
  };
  struct Intersection {
    double x;
    double z;
  };
  struct Ends {
    Intersection left;
    Intersection right;
  };
  static Intersection intersect(const Edge& edge, double y);
  /// Where the line at `y` enters and leaves the triangle; none where it has fewer than two intersections.
  [[nodiscard]] std::optional<Ends> ends(double y) const;
  [[nodiscard]] std::optional<Ends> ends_at_corner(double y) const;

  PixelGrid grid_;
  std::array<Edge, 3> edges_;
  std::optional<double> slope_;  // dz/dx of the triangle's plane; none for a triangle seen edge-on
  int first_row_;
  int last_row_;
};

}  // namespace pipeline
