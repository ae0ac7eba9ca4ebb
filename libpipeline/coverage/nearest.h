#pragma once

#include <optional>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/ball.h"
#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"

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

  /// Doubles are enough for the depths of a triangle whose depth changes, with its slopes in x and in y, over
  /// the window and the triangle by at most kSteepest times the sum of its vertices' |z|; if its area is more
  /// than kNarrowest of the sum of its two products, and its widest row wider than kNarrowestRow of a pixel.
  /// (The comparison adds up the three.) The depths of any other triangle are calculated as
  /// DoubleDoubles. Error bounds: tests/proofs/nearest_depth.g.
  static constexpr double kSteepest = 0x1p9, kNarrowest = 0x1p-40, kNarrowestRow = 0x1p-12;
  /// Both sides of the comparison are clamped to this, so that they cannot both become infinite.
  static constexpr double kHuge = 0x1p1000;

  NearestRows(const PixelGrid& grid, const Triangle& p_ndc);

  /// The rows that may have pixels, inside the screen; first_row() > last_row() if there are none.
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }

  /// The pixels the triangle covers on `row`, inside the screen; none where it has fewer than two
  /// intersections or lies entirely left or right of the screen. The depth is linear through the left
  /// intersection and has the slope of the triangle's plane; where left and right intersection have the same
  /// x, and where the triangle is seen edge-on, the depth is the smaller of the two. Everywhere else it is
  /// the plane's at the exact center of the pixel within 2^-39 of the largest |z| of a vertex; at a pixel
  /// whose center lies beyond an end of the row within 2^-28, or of its own |z| if that is larger.
  [[nodiscard]] std::optional<Span> span(int row) const;
  /// That depth exactly, at the center as Z1 of docs/stages.md rounds it: rules.h.
  [[nodiscard]] Ball exact_depth(int row, int column) const;

 private:
  struct Intersection {
    double x;
    double z;
  };
  struct Ends {
    Intersection left;
    Intersection right;
  };
  /// Where the line at `y` meets the edge. Inlined: a call would cost a third of it.
  [[gnu::always_inline]] static inline Intersection intersect(const Vec3& lower, const Vec3& upper, double y);
  /// Where the line at `y` enters and leaves the triangle; none where it has fewer than two intersections.
  [[nodiscard]] std::optional<Ends> ends(double y) const;
  [[nodiscard]] std::optional<Ends> ends_at_corner(double y) const;

  /// The span with a depth in pairs instead of doubles.
  [[gnu::noinline]] [[nodiscard]] Span refined(Span span) const;

  PixelGrid grid_;
  Triangle p_;  // by y, then x, then z, from the lowest: neighbors get the same point of a shared edge
  // dz/dx of the triangle's plane, none for a triangle seen edge-on. One slope for all rows: the quotient of
  // the differences between the ends of a row has no correct digit where the row crosses the triangle next to
  // a corner.
  std::optional<double> slope_;
  std::optional<DepthInPairs> in_pairs_;
  int first_row_;
  int last_row_;
};

}  // namespace pipeline
