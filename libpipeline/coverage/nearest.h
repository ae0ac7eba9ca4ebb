#pragma once

#include <optional>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/ball.h"
#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The depths of a triangle's plane with 106 bits, at unrounded pixel centers: for triangles so steep or so
/// narrow that doubles lose digits. Bound: tests/proofs/depth_in_pairs.g.
class DepthInPairs {
 public:
  /// The triangle must not be seen edge-on.
  DepthInPairs(const PixelGrid& grid, const Triangle& p_ndc);

  /// The depth along a row; none beyond a double's range. As in TriangleDepth, it starts from the middle and
  /// counts half columns, so both are whole numbers.
  [[nodiscard]] std::optional<SpanDepth> along(int row, int first_column, int last_column) const;

 private:
  PixelGrid grid_;
  Vec3 origin_;              // a vertex
  DoubleDouble slope_;       // dz/dx
  DoubleDouble slope_in_y_;  // dz/dy
  double half_slope_;        // per half column
};

/// The coverage rule `nearest` for one triangle in NDC: on every row whose line of pixel centers meets the
/// triangle, the pixels from the one nearest to the left intersection to the one nearest to the right, both
/// included (halfway: the pixel on the right). Neighboring triangles thus both own the pixels on a shared
/// edge, and a triangle that is narrower than a pixel still has one on each row. Horizontal edges do not
/// count; the others include both ends.
/// The pixels are decided in doubles, in a fixed order. Any finite coordinates are allowed, even if their
/// differences or products are not finite. Source: "Raster Based Graphics Pipeline", CSE 410 offline 2, 2022.
class NearestRows {
 public:
  /// A bound on the error of a triangle's area, a difference of two products, relative to their sum. Up to
  /// that bound, rounding hides whether the triangle is seen edge-on (J. Shewchuk, "Adaptive precision
  /// floating-point arithmetic and fast robust geometric predicates", 1997, ccwerrboundA).
  static constexpr double kAreaError = (3 + 16 * 0x1p-53) * 0x1p-53;

  /// Doubles are enough for a triangle's depths if three conditions hold: over the window and the triangle,
  /// its slopes change the depth by at most kSteepest times the sum of its vertices' |z|; its area is more
  /// than kNarrowest of the sum of its two products; its widest row is wider than kNarrowestRow of a pixel.
  /// (One comparison tests all three.) Other triangles' depths are calculated as DoubleDoubles. Error
  /// bounds: tests/proofs/nearest_depth.g.
  static constexpr double kSteepest = 0x1p9, kNarrowest = 0x1p-40, kNarrowestRow = 0x1p-12;
  /// That comparison's right side is clamped to this, lest both sides become infinite.
  static constexpr double kHuge = 0x1p1000;

  NearestRows(const PixelGrid& grid, const Triangle& p_ndc);

  /// The rows that may have pixels, inside the screen; first_row() > last_row() if there are none.
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }

  /// The pixels that the triangle covers on `row`, inside the screen; none if the row has fewer than two
  /// intersections or lies entirely left or right of the screen. The depth is linear through the left
  /// intersection and has the slope of the triangle's plane; if both intersections have the same x, or the
  /// triangle is seen edge-on, it is the smaller of their two depths. Everywhere else, it is the plane's
  /// depth at the pixel's exact center within 2^-39 of the largest |z| of a vertex; if the center lies beyond
  /// an end of the row, within 2^-28 of that or of its own |z|, whichever is larger.
  [[nodiscard]] std::optional<Span> span(int row) const;
  /// The exact depth, at the center as rounded by Z1 of docs/stages.md; see rules.h.
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
  /// The intersection of the line at `y` with the edge. Inlined: a call would cost a third of the time.
  [[gnu::always_inline]] static inline Intersection intersect(const Vec3& lower, const Vec3& upper, double y);
  /// The points where the line at `y` enters and leaves the triangle; none if it has fewer than two.
  [[nodiscard]] std::optional<Ends> ends(double y) const;
  [[nodiscard]] std::optional<Ends> ends_at_corner(double y) const;

  /// The span with a depth in pairs instead of doubles.
  [[gnu::noinline]] [[nodiscard]] Span refined(Span span) const;

  PixelGrid grid_;
  Triangle p_;  // sorted by y, x, z from the lowest: neighbors get the same point of a shared edge
  // dz/dx of the triangle's plane; none for a triangle seen edge-on. One slope serves all rows: next to a
  // corner, the quotient of the differences between a row's ends has no correct digit.
  std::optional<double> slope_;
  std::optional<DepthInPairs> in_pairs_;
  int first_row_;
  int last_row_;
};

}  // namespace pipeline
