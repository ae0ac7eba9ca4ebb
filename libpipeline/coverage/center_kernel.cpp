#include <array>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/triangle_depth.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/coverage/center_kernel.cpp"
#include "libpipeline/coverage/double_rows.h"

PIPELINE_BEGIN_KERNELS();

#if HWY_TARGET == HWY_SCALAR

/// The plane of one triangle.
Planes plane_of(const ExactGrid& grid, const ExactTriangle& triangle) {
  std::array<Vectors, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = triangle.p_ndc[i];
    corners[i] = {all(p.x), all(p.y), all(p.z)};
  }
  return {PixelAxis(grid.columns), PixelAxis(grid.rows), corners, [&](unsigned mark) {
            return hn::Eq(all((triangle.decimal_marks >> mark & 1u) != 0 ? 0 : 1), all(0));
          }};
}

#else

// CenterRows in doubles instead of 64 bits: doubles hold whole numbers up to 2^53. Triangles whose numbers
// could be larger are left to CenterRows.
static_assert(kMaxExactDouble <= DepthInDoubles::kMaxWeight);

/// The smallest whole c in [0, most] with c * divisor >= dividend, or `most` if there is none. The estimate
/// for a dividend up to 2^50 is off by at most 1/4, so c is the nearest whole number or the next.
HWY_INLINE Doubles quotient_rounded_up(Doubles dividend, Doubles divisor, Doubles inverse, Doubles most) {
  const Doubles near = hn::Round(dividend * inverse);
  const Doubles quotient = near + hn::IfThenElseZero(hn::Lt(near * divisor, dividend), all(1));
  return hn::Min(most, hn::Max(all(0), quotient));
}

/// An AxisInDoubles, in all lanes.
struct AxisLanes {
  HWY_INLINE explicit AxisLanes(const GridAxis& axis)
      : count(all(axis.in_doubles.count)),
        step(all(axis.in_doubles.step)),
        inverse(all(axis.in_doubles.inverse_step)),
        factor(all(axis.in_doubles.vertex_factor)),
        origin(all(axis.in_doubles.origin)),
        largest(all(axis.in_doubles.largest)) {}

  /// A coordinate's distance from the middle, on the grid.
  HWY_INLINE Doubles scaled(Doubles coordinate) const {
    return hn::Round(coordinate * all(kGridUnitsPerOne)) * factor;
  }
  /// True if all distances from pixel 0 in [least, most] are calculated exactly.
  HWY_INLINE Mask fit(Doubles least, Doubles most) const {
    return hn::Le(hn::Max(hn::Abs(most), hn::Abs(least)), largest);
  }
  /// The first pixel at or after a distance.
  HWY_INLINE Doubles pixel(Doubles distance) const {
    return quotient_rounded_up(distance, step, inverse, count);
  }

  Doubles count;
  Doubles step;
  Doubles inverse;
  Doubles factor;
  Doubles origin;
  Doubles largest;
};

struct Edges {
  Doubles crossing;
  Doubles row_step;
  Doubles column_step;
  Doubles inverse;
};

HWY_INLINE Edges choose(Mask mask, const Edges& yes, const Edges& no) {
  return {choose(mask, yes.crossing, no.crossing), choose(mask, yes.row_step, no.row_step),
          choose(mask, yes.column_step, no.column_step), choose(mask, yes.inverse, no.inverse)};
}

/// The numbers from which rows are calculated (see ExactRows): of some triangles, or of one in all lanes.
struct RowSources {
  Doubles first_row;
  Doubles middle_row;
  Doubles end_row;
  Doubles first_column;
  Doubles column_count;
  // The corners a, b, c are sorted from the top.
  Mask longest_is_left;
  Doubles twice_total;  // of the weights
  Mask is_flat;         // all vertices have one depth
  Doubles a_z;
  Doubles b_z;
  Doubles c_z;
  Edges longest;  // a to c
  Edges upper;    // a to b
  Edges lower;    // b to c
};

/// Some triangles prepared for their rows.
struct TriangleLanes {
  HWY_INLINE TriangleLanes(const AxisLanes& columns, const AxisLanes& rows, const TaggedTriangle* triangles,
                           const RowRange& range) {
    const auto [a, b, c] = vertices_of(triangles);
    const Vectors p = on_grid(columns, rows, a);
    const Vectors q = on_grid(columns, rows, b);
    const Vectors r = on_grid(columns, rows, c);

    const Doubles u_left = hn::Min(r.x, hn::Min(q.x, p.x)), u_right = hn::Max(r.x, hn::Max(q.x, p.x));
    const Doubles v_top = hn::Min(r.y, hn::Min(q.y, p.y)), v_bottom = hn::Max(r.y, hn::Max(q.y, p.y));
    const Mask fits = hn::And(columns.fit(u_left, u_right), rows.fit(v_top, v_bottom));
    // A column at or before the first that can be covered.
    const Doubles left = hn::Max(all(0), hn::Round(u_left * columns.inverse) - all(1));
    // The bound of largest_product, from this column. Triangles without a row may have larger products, which
    // are never used.
    const Doubles first = left * columns.step;
    const Doubles x = hn::Max(hn::Abs(u_right - first), hn::Abs(u_left - first)) + all(2) * columns.step;
    const Doubles y = v_bottom - v_top + rows.step;
    ordinary.bits = bits_of(hn::And(fits, hn::Le(all(4) * x * y, all(kMaxExactDouble))));

    const Mask is_beside = hn::Or(hn::Lt(u_right, all(0)), hn::Le(columns.count, left));
    sources.first_column = left;
    sources.column_count = columns.count - left;
    // Sorted from the top by the first row at or below a vertex, then by the vertex number.
    const Doubles p_row = rows.pixel(p.y), q_row = rows.pixel(q.y), r_row = rows.pixel(r.y);
    const Doubles high_row = hn::Min(q_row, p_row), low_row = hn::Max(q_row, p_row);
    sources.first_row = hn::Min(r_row, high_row);
    sources.middle_row = hn::Max(hn::Min(r_row, low_row), high_row);
    const Mask q_first = hn::Lt(q_row, p_row);
    const Mask r_before_high = hn::Lt(r_row, high_row), r_before_low = hn::Lt(r_row, low_row);
    const Vectors high = choose(q_first, q, p), low = choose(q_first, p, q);
    set_corners(columns, rows, left, choose(r_before_high, r, high),
                choose(r_before_high, high, choose(r_before_low, r, low)), choose(r_before_low, low, r),
                hn::Min(all(range.end), hn::Max(r_row, low_row)), is_beside);
    begin_row = hn::Max(all(range.first), sources.first_row);
  }

  HWY_INLINE Doubles end_row() const { return sources.end_row; }

  RowSources sources;
  Doubles begin_row;  // the first row in the range
  LaneSet ordinary;   // triangles whose numbers doubles hold exactly
  Numbers half_slope;

 private:
  /// Vertices on the grid: x to the right and y down, in its units; z is unchanged.
  HWY_INLINE static Vectors on_grid(const AxisLanes& columns, const AxisLanes& rows, const Vectors& p) {
    return {columns.origin + columns.scaled(p.x), rows.origin - rows.scaled(p.y), p.z};
  }
  HWY_INLINE void set_corners(const AxisLanes& columns, const AxisLanes& rows, Doubles left, const Vectors& a,
                              const Vectors& b, const Vectors& c, Doubles end_row, Mask is_beside) {
    const Doubles weight = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    sources.longest_is_left = hn::Lt(all(0), weight);
    // All weights have the same sign as their sum.
    set_depth(a.z, b.z, c.z, weight + weight, columns.step * (c.y - a.y), columns.step * (a.y - b.y));

    const Mask is_empty = hn::Or(hn::Eq(weight, all(0)), is_beside);
    sources.end_row = choose(is_empty, sources.first_row, end_row);

    const Doubles first_u = left * columns.step, first_v = sources.first_row * rows.step;
    const auto edge = [&](const Vectors& from, const Vectors& to) HWY_ATTR {
      const Doubles du = to.x - from.x, dv = to.y - from.y, column_step = columns.step * dv;
      return Edges{(from.x - first_u) * dv + (first_v - from.y) * du, rows.step * du, column_step,
                   all(1) / column_step};
    };
    sources.longest = edge(a, c);
    sources.upper = edge(a, b);
    sources.lower = edge(b, c);
  }
  /// See DepthInDoubles.
  HWY_INLINE void set_depth(Doubles a, Doubles b, Doubles c, Doubles twice_weights, Doubles b_step,
                            Doubles c_step) {
    const Mask flat = hn::And(hn::Eq(a, b), hn::Eq(a, c));
    const Doubles size = hn::Max(hn::Abs(c), hn::Max(hn::Abs(b), hn::Abs(a)));
    const Mask is_in_range =
        hn::And(hn::Le(all(DepthInDoubles::kMinDepth), size), hn::Le(size, all(DepthInDoubles::kMaxDepth)));
    ordinary.bits &= bits_of(hn::Or(flat, is_in_range));

    const Pairs of_two = two_sum(b_step * b, c_step * c);
    const Pairs of_three = two_sum(of_two.hi, (all(0) - b_step - c_step) * a);
    const Doubles slope =
        (of_three.hi + (of_two.lo + of_three.lo)) / twice_weights + all(DepthInDoubles::kNoMinus);
    half_slope = numbers_of(hn::IfThenZeroElse(flat, slope));
    sources.is_flat = flat;
    sources.twice_total = twice_weights;
    sources.a_z = a;
    sources.b_z = b;
    sources.c_z = c;
  }
};

/// One row each of some triangles, or some rows of one triangle. All rows of ordinary triangles are ordinary.
struct RowLanes {
  RowLanes() = default;
  /// Finds the covered pixels.
  HWY_INLINE RowLanes(const RowSources& of, Doubles rows) {
    const Mask is_upper = hn::Lt(rows, of.middle_row);
    const Doubles row_count = rows - of.first_row;
    const Edges shorter = choose(is_upper, of.upper, of.lower);
    const Doubles longest_crossing = of.longest.crossing + row_count * of.longest.row_step;
    const Doubles shorter_crossing = shorter.crossing + row_count * shorter.row_step;
    const Doubles longest_pixel =
        quotient_rounded_up(longest_crossing, of.longest.column_step, of.longest.inverse, of.column_count);
    const Doubles shorter_pixel =
        quotient_rounded_up(shorter_crossing, shorter.column_step, shorter.inverse, of.column_count);
    const Doubles first = choose(of.longest_is_left, longest_pixel, shorter_pixel);
    const Doubles end = choose(of.longest_is_left, shorter_pixel, longest_pixel);
    const Mask is_there = hn::Lt(rows, of.end_row);
    spans.set_columns(rows, hn::IfThenElseZero(is_there, of.first_column + first),
                      hn::IfThenElseZero(is_there, of.first_column + end) - all(1));

    // The weights of the vertices opposite to the edges: the sums of those at the first and the last pixel.
    const Doubles sum = longest_pixel + shorter_pixel - all(1);
    opposite_longest_ = sum * of.longest.column_step - (longest_crossing + longest_crossing);
    opposite_shorter_ = (shorter_crossing + shorter_crossing) - sum * shorter.column_step;
    is_upper_ = is_upper;
    columns_added_up_ = of.first_column + of.first_column + sum;
  }
  /// Sets the spans' depths.
  HWY_INLINE void set_depths(const RowSources& of) {
    const Doubles rest = of.twice_total - opposite_longest_ - opposite_shorter_;
    const Doubles twice_c = choose(is_upper_, opposite_shorter_, rest);
    const Doubles twice_a = choose(is_upper_, rest, opposite_shorter_);
    const Doubles mean =
        ((opposite_longest_ * of.b_z + twice_c * of.c_z) + twice_a * of.a_z) / of.twice_total +
        all(DepthInDoubles::kNoMinus);
    spans.set_points(columns_added_up_, choose(of.is_flat, of.a_z, mean));
  }
  static LaneSet ordinary() { return {}; }

  LaneSpans spans;

 private:
  Doubles columns_added_up_;  // the sum of the first and the last
  Mask is_upper_;
  // The weights of the vertices opposite to these edges.
  Doubles opposite_longest_;
  Doubles opposite_shorter_;
};

/// The rule `center` for triangle_lanes.h; the types are those of an axis, triangles and their rows.
template <typename Axes, typename Triangles, typename Rows>
struct RuleOf {
  using RowLanes = Rows;
  HWY_INLINE explicit RuleOf(const ExactGrid& exact_grid)
      : grid(exact_grid), columns(exact_grid.columns), row_axis(exact_grid.rows) {}

  [[nodiscard]] CenterRows rows(const TaggedTriangle& triangle) const { return {grid, triangle.triangle}; }
  HWY_INLINE Triangles prepared(const TaggedTriangle* triangles, const RowRange& range) const {
    return {columns, row_axis, triangles, range};
  }
  template <typename Sources>
  HWY_INLINE static Rows some_rows(const Sources& sources, Doubles rows) {
    return {sources, rows};
  }
  static double slope(const Triangles& four, std::size_t lane, const Rows&, std::size_t) {
    return four.half_slope[lane];
  }
  /// Columns are counted in halves.
  static Axis axis() { return {0, 2}; }

  const ExactGrid& grid;
  Axes columns;
  Axes row_axis;
};
using Rule = RuleOf<AxisLanes, TriangleLanes, RowLanes>;
/// The rule for triangles with coordinates other than decimals.
using DoubleRule = RuleOf<PixelAxis, DoubleTriangleLanes, DoubleRowLanes>;

template <typename Rule>
TaggedSpan* append_by(const Rule& rule, const TaggedTriangle* triangles, const RowRange& rows,
                      TaggedSpan* spans) {
  return append_triangles(rule, rule.prepared(triangles, rows), triangles, rows, spans);
}

#endif

TaggedSpan* append_each(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                        const RowRange& rows, TaggedSpan* spans) {
  for (const auto& [triangle, tag] : triangles)
    spans = append_spans(CenterRows(grid, triangle), tag, rows, spans);
  return spans;
}

TaggedSpan* center_spans(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                         const RowRange& rows, TaggedSpan* spans) {
#if HWY_TARGET != HWY_SCALAR
  for (; triangles.size() >= kLanes; triangles = triangles.subspan(kLanes)) {
    // Usually all triangles of a text have decimals, or none has.
    std::size_t decimal_count = 0;
    for (std::size_t i = 0; i < kLanes; ++i) decimal_count += triangles[i].triangle.is_decimal() ? 1 : 0;
    spans = decimal_count == kLanes ? append_by(Rule(grid), triangles.data(), rows, spans)
            : decimal_count == 0    ? append_by(DoubleRule(grid), triangles.data(), rows, spans)
                                    : append_each(grid, triangles.first(kLanes), rows, spans);
  }
#endif
  return append_each(grid, triangles, rows, spans);
}

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {

std::optional<DepthPlane> depth_plane(const ExactGrid& grid, const ExactTriangle& triangle) {
  using namespace N_SCALAR;
  const auto pair = [](const Pairs& value) {
    return DoubleDouble{number_in(value.hi, 0), number_in(value.lo, 0)};
  };
  const Planes planes = plane_of(grid, triangle);
  if (bits_of(planes.are_certain) == 0) return std::nullopt;
  return DepthPlane{pair(planes.corner), pair(planes.per_column), pair(planes.per_row)};
}

SpanDepth depth_along(const DepthPlane& plane, int row, int first_column, int last_column) {
  using namespace N_SCALAR;
  const double columns = first_column + last_column;
  const Pairs per_column = all(plane.per_column);
  const Doubles middle =
      middle_depth(all(plane.corner), per_column, all(plane.per_row), all(columns), all(row));
  return {0, 2, columns, number_in(middle, 0), number_in(half_slope_of(per_column), 0)};
}

constinit const KernelTable<CenterSpans> kCenterKernels = PIPELINE_KERNEL_TABLE(center_spans);

}  // namespace pipeline

#endif
