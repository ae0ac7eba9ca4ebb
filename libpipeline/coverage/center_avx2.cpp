#include <array>

#include "libpipeline/coverage/append_four.h"
#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/depth_in_doubles.h"
#include "libpipeline/coverage/four_doubles.h"
#include "libpipeline/coverage/four_points.h"
#include "libpipeline/coverage/four_spans.h"
#include "libpipeline/coverage/kernel.h"

#if defined(__x86_64__) && defined(__GNUC__)

namespace pipeline {
namespace {

// CenterRows in doubles instead of 64 bits: they hold whole numbers up to 2^53. Triangles whose numbers could
// be larger are left to CenterRows.
static_assert(kMaxExactDouble <= DepthInDoubles::kMaxWeight);

PIPELINE_AVX2_INLINE FourDoubles nearest_whole(FourDoubles value) {
  return _mm256_round_pd(value, _MM_FROUND_TO_NEAREST_INT | _MM_FROUND_NO_EXC);
}

/// The smallest whole c in [0, most] with c * divisor >= dividend, or `most` if there is none. The estimate
/// for a dividend up to 2^50 is off by at most 1/4, so c is the whole number nearest to it or the one after
/// that.
PIPELINE_AVX2_INLINE FourDoubles quotient_rounded_up(FourDoubles dividend, FourDoubles divisor,
                                                     FourDoubles inverse, FourDoubles most) {
  const FourDoubles near = nearest_whole(dividend * inverse);
  const FourDoubles quotient = near + both(is_less(near * divisor, dividend), all(1));
  return smaller(larger(quotient, all(0)), most);
}

struct FourSums {
  FourDoubles sum;
  FourDoubles lost;  // in it
};

/// As two_sum() of two doubles.
PIPELINE_AVX2_INLINE FourSums two_sum(FourDoubles a, FourDoubles b) {
  const FourDoubles sum = a + b;
  const FourDoubles b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

/// An AxisInDoubles, four times.
struct AxisLanes {
  PIPELINE_AVX2_INLINE explicit AxisLanes(const AxisInDoubles& axis)
      : count(all(axis.count)),
        step(all(axis.step)),
        inverse(all(axis.inverse_step)),
        factor(all(axis.vertex_factor)),
        origin(all(axis.origin)),
        largest(all(axis.largest)) {}

  /// How far a coordinate is from the middle, on the grid.
  PIPELINE_AVX2_INLINE FourDoubles scaled(FourDoubles coordinate) const {
    return nearest_whole(coordinate * all(kGridUnitsPerOne)) * factor;
  }
  /// Whether the calculated distances from pixel 0, of which these are the extremes, are exact.
  PIPELINE_AVX2_INLINE FourDoubles fit(FourDoubles least, FourDoubles most) const {
    return is_at_most(larger(size_of(least), size_of(most)), largest);
  }
  /// The first pixel at or after that.
  PIPELINE_AVX2_INLINE FourDoubles pixel(FourDoubles distance) const {
    return quotient_rounded_up(distance, step, inverse, count);
  }

  FourDoubles count;
  FourDoubles step;
  FourDoubles inverse;
  FourDoubles factor;
  FourDoubles origin;
  FourDoubles largest;
};

/// A vertex of each of four triangles on the grid.
struct GridPoints {
  FourDoubles u;
  FourDoubles v;
  FourDoubles z;
};

PIPELINE_AVX2_INLINE GridPoints pick_points(FourDoubles mask, const GridPoints& yes, const GridPoints& no) {
  return {pick(mask, yes.u, no.u), pick(mask, yes.v, no.v), pick(mask, yes.z, no.z)};
}

struct FourEdges {
  PIPELINE_AVX2_INLINE FourEdges of(std::size_t lane) const {
    return {all(crossing[lane]), all(row_step[lane]), all(column_step[lane]), all(inverse[lane])};
  }

  FourDoubles crossing;
  FourDoubles row_step;
  FourDoubles column_step;
  FourDoubles inverse;
};

/// The numbers from which the rows of four triangles are calculated (see ExactRows), or those of one, four
/// times.
struct RowSources {
  PIPELINE_AVX2_INLINE RowSources of(std::size_t lane) const {
    return {all(first_row[lane]),    all(middle_row[lane]),   all(end_row[lane]),
            all(first_column[lane]), all(column_count[lane]), all(longest_is_left[lane]),
            all(twice_total[lane]),  all(is_flat[lane]),      all(a_z[lane]),
            all(b_z[lane]),          all(c_z[lane]),          longest.of(lane),
            upper.of(lane),          lower.of(lane)};
  }

  FourDoubles first_row;
  FourDoubles middle_row;
  FourDoubles end_row;
  FourDoubles first_column;
  FourDoubles column_count;
  // The corners a, b, c are sorted from the top.
  FourDoubles longest_is_left;  // a mask
  FourDoubles twice_total;      // of the weights
  FourDoubles is_flat;          // a mask: all of one depth
  FourDoubles a_z;
  FourDoubles b_z;
  FourDoubles c_z;
  FourEdges longest;  // a to c
  FourEdges upper;    // a to b
  FourEdges lower;    // b to c
};

/// Four triangles prepared for their rows.
struct FourTriangles {
  PIPELINE_AVX2_INLINE FourTriangles(const AxisLanes& columns, const AxisLanes& rows,
                                     const TaggedTriangle* triangles, const RowRange& range) {
    const auto [a, b, c] = vertices_of(triangles);
    const GridPoints p = on_grid(columns, rows, a);
    const GridPoints q = on_grid(columns, rows, b);
    const GridPoints r = on_grid(columns, rows, c);

    const FourDoubles u_left = smaller(smaller(p.u, q.u), r.u), u_right = larger(larger(p.u, q.u), r.u);
    const FourDoubles v_top = smaller(smaller(p.v, q.v), r.v), v_bottom = larger(larger(p.v, q.v), r.v);
    const FourDoubles fits = both(columns.fit(u_left, u_right), rows.fit(v_top, v_bottom));
    // A column at or before the first that may be covered.
    const FourDoubles left = larger(nearest_whole(u_left * columns.inverse) - all(1), all(0));
    // The bound of largest_product, from that column. Triangles without a row may have larger products, which
    // are never used.
    const FourDoubles first = left * columns.step;
    const FourDoubles x = larger(size_of(u_left - first), size_of(u_right - first)) + all(2) * columns.step;
    const FourDoubles y = v_bottom - v_top + rows.step;
    ordinary.bits = marks(triangles) & bits_of(both(fits, is_at_most(all(4) * x * y, all(kMaxExactDouble))));

    const FourDoubles is_beside = either(is_less(u_right, all(0)), is_at_most(columns.count, left));
    sources.first_column = left;
    sources.column_count = columns.count - left;
    // Sorted from the top by the first row at or below a vertex, then by the vertex number.
    const FourDoubles p_row = rows.pixel(p.v), q_row = rows.pixel(q.v), r_row = rows.pixel(r.v);
    const FourDoubles high_row = smaller(p_row, q_row), low_row = larger(p_row, q_row);
    sources.first_row = smaller(high_row, r_row);
    sources.middle_row = larger(high_row, smaller(low_row, r_row));
    const FourDoubles q_first = is_less(q_row, p_row);
    const FourDoubles r_before_high = is_less(r_row, high_row), r_before_low = is_less(r_row, low_row);
    const GridPoints high = pick_points(q_first, q, p), low = pick_points(q_first, p, q);
    set_corners(columns, rows, left, pick_points(r_before_high, r, high),
                pick_points(r_before_high, high, pick_points(r_before_low, r, low)),
                pick_points(r_before_low, low, r), smaller(larger(low_row, r_row), all(range.end)),
                is_beside);
    begin_row = larger(sources.first_row, all(range.first));
  }

  PIPELINE_AVX2_INLINE FourDoubles end_row() const { return sources.end_row; }

  RowSources sources;
  FourDoubles begin_row;  // the first in the range
  LaneSet ordinary;       // triangles whose numbers doubles hold exactly
  FourNumbers half_slope;

 private:
  PIPELINE_AVX2_INLINE static GridPoints on_grid(const AxisLanes& columns, const AxisLanes& rows,
                                                 const FourPoints& p) {
    return {columns.origin + columns.scaled(p.x), rows.origin - rows.scaled(p.y), p.z};
  }
  /// A bit for each triangle whose x and y are decimals. Usually all are.
  static int marks(const TaggedTriangle* triangles) {
    ExactTriangle all_of_them = triangles[0].triangle;
    for (std::size_t i = 1; i < kFour; ++i) all_of_them.decimal_marks &= triangles[i].triangle.decimal_marks;
    if (all_of_them.is_decimal()) return LaneSet::kAll;
    int result = 0;
    for (std::size_t i = 0; i < kFour; ++i)
      result |= static_cast<int>(triangles[i].triangle.is_decimal()) << i;
    return result;
  }
  PIPELINE_AVX2_INLINE void set_corners(const AxisLanes& columns, const AxisLanes& rows, FourDoubles left,
                                        const GridPoints& a, const GridPoints& b, const GridPoints& c,
                                        FourDoubles end_row, FourDoubles is_beside) {
    const FourDoubles weight = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
    sources.longest_is_left = is_less(all(0), weight);
    // All weights and their sum have the same sign, whichever it is.
    set_depth(a.z, b.z, c.z, weight + weight, columns.step * (c.v - a.v), columns.step * (a.v - b.v));

    const FourDoubles is_empty = either(is_equal(weight, all(0)), is_beside);
    sources.end_row = pick(is_empty, sources.first_row, end_row);

    const FourDoubles first_u = left * columns.step, first_v = sources.first_row * rows.step;
    const auto edge = [&](const GridPoints& from, const GridPoints& to) PIPELINE_AVX2 {
      const FourDoubles du = to.u - from.u, dv = to.v - from.v, column_step = columns.step * dv;
      return FourEdges{(from.u - first_u) * dv + (first_v - from.v) * du, rows.step * du, column_step,
                       all(1) / column_step};
    };
    sources.longest = edge(a, c);
    sources.upper = edge(a, b);
    sources.lower = edge(b, c);
  }
  /// See DepthInDoubles.
  PIPELINE_AVX2_INLINE void set_depth(FourDoubles a, FourDoubles b, FourDoubles c, FourDoubles twice_weights,
                                      FourDoubles b_step, FourDoubles c_step) {
    const FourDoubles flat = both(is_equal(a, b), is_equal(a, c));
    const FourDoubles size = larger(larger(size_of(a), size_of(b)), size_of(c));
    const FourDoubles is_in_range = both(is_at_most(all(DepthInDoubles::kMinDepth), size),
                                         is_at_most(size, all(DepthInDoubles::kMaxDepth)));
    ordinary.bits &= bits_of(either(flat, is_in_range));

    const FourSums of_two = two_sum(b_step * b, c_step * c);
    const FourSums of_three = two_sum(of_two.sum, (-b_step - c_step) * a);
    const FourDoubles slope =
        (of_three.sum + (of_two.lost + of_three.lost)) / twice_weights + all(DepthInDoubles::kNoMinus);
    half_slope = numbers_of(but_not(slope, flat));
    sources.is_flat = flat;
    sources.twice_total = twice_weights;
    sources.a_z = a;
    sources.b_z = b;
    sources.c_z = c;
  }
};

/// A row of each of four triangles, or four rows of one. All are ordinary where the triangles are.
struct FourRows {
  FourRows() = default;
  /// Which pixels are covered.
  PIPELINE_AVX2_INLINE FourRows(const RowSources& of, FourDoubles rows) {
    const FourDoubles is_upper = is_less(rows, of.middle_row);
    const FourDoubles row_count = rows - of.first_row;
    const FourEdges shorter = pick_edges(is_upper, of.upper, of.lower);
    const FourDoubles longest_crossing = of.longest.crossing + row_count * of.longest.row_step;
    const FourDoubles shorter_crossing = shorter.crossing + row_count * shorter.row_step;
    const FourDoubles longest_pixel =
        quotient_rounded_up(longest_crossing, of.longest.column_step, of.longest.inverse, of.column_count);
    const FourDoubles shorter_pixel =
        quotient_rounded_up(shorter_crossing, shorter.column_step, shorter.inverse, of.column_count);
    const FourDoubles first = pick(of.longest_is_left, longest_pixel, shorter_pixel);
    const FourDoubles end = pick(of.longest_is_left, shorter_pixel, longest_pixel);
    const FourDoubles is_there = is_less(rows, of.end_row);
    spans.set_columns(rows, both(is_there, of.first_column + first),
                      both(is_there, of.first_column + end) - all(1));

    // The weights of the vertices opposite to the edges, at the first and at the last pixel added up.
    const FourDoubles sum = longest_pixel + shorter_pixel - all(1);
    opposite_longest_ = sum * of.longest.column_step - (longest_crossing + longest_crossing);
    opposite_shorter_ = (shorter_crossing + shorter_crossing) - sum * shorter.column_step;
    is_upper_ = is_upper;
    columns_added_up_ = of.first_column + of.first_column + sum;
  }
  /// Sets their depths.
  PIPELINE_AVX2_INLINE void set_depths(const RowSources& of) {
    const FourDoubles rest = of.twice_total - opposite_longest_ - opposite_shorter_;
    const FourDoubles twice_c = pick(is_upper_, opposite_shorter_, rest);
    const FourDoubles twice_a = pick(is_upper_, rest, opposite_shorter_);
    const FourDoubles mean =
        ((opposite_longest_ * of.b_z + twice_c * of.c_z) + twice_a * of.a_z) / of.twice_total +
        all(DepthInDoubles::kNoMinus);
    spans.set_points(columns_added_up_, pick(of.is_flat, of.a_z, mean));
  }

  FourSpans spans;

 private:
  FourDoubles columns_added_up_;  // the first and the last
  FourDoubles is_upper_;          // a mask
  // Weights of vertices.
  FourDoubles opposite_longest_;
  FourDoubles opposite_shorter_;

  PIPELINE_AVX2_INLINE static FourEdges pick_edges(FourDoubles mask, const FourEdges& yes,
                                                   const FourEdges& no) {
    return {pick(mask, yes.crossing, no.crossing), pick(mask, yes.row_step, no.row_step),
            pick(mask, yes.column_step, no.column_step), pick(mask, yes.inverse, no.inverse)};
  }
};

/// The rule `center` for append_four.h.
struct Rule {
  using FourRows = pipeline::FourRows;
  PIPELINE_AVX2_INLINE explicit Rule(const ExactGrid& exact_grid)
      : grid(exact_grid), column_axis(exact_grid.columns.in_doubles), row_axis(exact_grid.rows.in_doubles) {}

  [[nodiscard]] CenterRows rows(const TaggedTriangle& triangle) const { return {grid, triangle.triangle}; }
  PIPELINE_AVX2_INLINE FourTriangles four(const TaggedTriangle* triangles, const RowRange& range) const {
    return {column_axis, row_axis, triangles, range};
  }
  PIPELINE_AVX2_INLINE static FourRows four_rows(const RowSources& sources, FourDoubles rows) {
    return {sources, rows};
  }
  static double slope(const FourTriangles& four, std::size_t lane, const FourRows&, std::size_t) {
    return four.half_slope[lane];
  }
  /// Columns are counted in halves.
  PIPELINE_AVX2_INLINE static __m128d axis() { return _mm_setr_pd(0, 2); }

  const ExactGrid& grid;
  AxisLanes column_axis;
  AxisLanes row_axis;
};

}  // namespace

PIPELINE_AVX2 TaggedSpan* center_spans_avx2(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                                            const RowRange& rows, TaggedSpan* spans) {
  return append_four_by_four(Rule(grid), triangles, rows, spans);
}

}  // namespace pipeline

#endif
