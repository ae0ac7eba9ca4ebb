#include <algorithm>
#include <cstdint>

#include "libpipeline/coverage_avx2.h"
#include "libpipeline/coverage_center.h"
#include "libpipeline/four_doubles.h"
#include "libpipeline/plain_depth.h"

#if defined(__x86_64__) && defined(__GNUC__)

namespace pipeline {
namespace {

constexpr std::size_t kCount = 4;

// What CenterRows does in 64 bits, in doubles, which hold whole numbers up to 2^53. Triangles whose numbers
// could be larger are left to CenterRows.
constexpr double kLargestWhole = 0x1p50;
static_assert(kLargestWhole <= PlainDepth::kLargestWeight);

/// The smallest whole c in [0, most] with c * divisor >= dividend, or `most` if there is none; see Divisor.
PIPELINE_AVX2_INLINE FourDoubles quotient_rounded_up(FourDoubles dividend, FourDoubles divisor,
                                                     FourDoubles inverse, FourDoubles most) {
  const FourDoubles estimate = smaller(larger(dividend * inverse, all(-1)), most);
  const FourDoubles near = _mm256_round_pd(estimate + all(0.5), _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
  return smaller(near + both(is_less(near * divisor, dividend), all(1)), most);
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

/// A GridAxis in doubles.
struct AxisLanes {
  PIPELINE_AVX2_INLINE explicit AxisLanes(const GridAxis& axis)
      : most(all(axis.count)),
        step(all(static_cast<double>(axis.narrow_step.value()))),
        inverse(all(1) / step),
        factor(all(static_cast<double>(axis.narrow_vertex_factor))),
        origin(all(static_cast<double>(axis.narrow_origin))),
        largest_units(smaller(all(axis.largest_narrow_units), all(kLargestWhole) / factor)) {}

  /// Whether the whole axis is of the size that is done here.
  static bool is_small(const GridAxis& axis) {
    return axis.largest_narrow_units > 0 &&
           static_cast<double>(axis.narrow_step.value()) * axis.count <= kLargestWhole;
  }
  PIPELINE_AVX2_INLINE static FourDoubles units_of(FourDoubles coordinate) {
    return coordinate * all(kGridUnitsPerOne);
  }
  PIPELINE_AVX2_INLINE FourDoubles fits(FourDoubles units) const {
    return is_at_most(size_of(units), largest_units);
  }
  /// How far a coordinate is from pixel 0, on the grid.
  PIPELINE_AVX2_INLINE FourDoubles scaled(FourDoubles units) const {
    const FourDoubles rounder = all(0x1.8p52);
    return ((units + rounder) - rounder) * factor;
  }
  /// The first pixel at or after that.
  PIPELINE_AVX2_INLINE FourDoubles pixel(FourDoubles distance) const {
    return quotient_rounded_up(distance, step, inverse, most);
  }

  FourDoubles most;
  FourDoubles step;
  FourDoubles inverse;
  FourDoubles factor;
  FourDoubles origin;
  FourDoubles largest_units;
};

/// A vertex of each of four triangles on the grid.
struct GridPoints {
  FourDoubles u;
  FourDoubles v;
  FourDoubles z;
  FourDoubles row;  // the first at or below it
  FourDoubles key;  // what they are sorted by: the row, then the number of the vertex
};

PIPELINE_AVX2_INLINE GridPoints pick_points(FourDoubles mask, const GridPoints& yes, const GridPoints& no) {
  return {pick(mask, yes.u, no.u), pick(mask, yes.v, no.v), pick(mask, yes.z, no.z),
          pick(mask, yes.row, no.row), pick(mask, yes.key, no.key)};
}

struct FourEdges {
  FourDoubles crossing;
  FourDoubles row_step;
  FourDoubles column_step;
  FourDoubles inverse;
};

/// The same, each on its own.
struct EdgeNumbers {
  PIPELINE_AVX2_INLINE EdgeNumbers& operator=(const FourEdges& edges) {
    crossing = numbers_of(edges.crossing);
    row_step = numbers_of(edges.row_step);
    column_step = numbers_of(edges.column_step);
    inverse = numbers_of(edges.inverse);
    return *this;
  }
  /// One of them, four times.
  PIPELINE_AVX2_INLINE FourEdges operator[](std::size_t lane) const {
    return {all(crossing[lane]), all(row_step[lane]), all(column_step[lane]), all(inverse[lane])};
  }

  FourNumbers crossing;
  FourNumbers row_step;
  FourNumbers column_step;
  FourNumbers inverse;
};

/// Four triangles made ready for their rows; see ExactRows.
struct FourTriangles {
  PIPELINE_AVX2_INLINE FourTriangles(const AxisLanes& columns, const AxisLanes& rows,
                                     const ColoredTriangle* triangles) {
    const FourDoubles zero = all(0);
    FourDoubles fits = is_equal(zero, zero);
    const GridPoints p = point(columns, rows, triangles, 0, fits);
    const GridPoints q = point(columns, rows, triangles, 1, fits);
    const GridPoints r = point(columns, rows, triangles, 2, fits);

    const FourDoubles u_left = smaller(smaller(p.u, q.u), r.u), u_right = larger(larger(p.u, q.u), r.u);
    const FourDoubles v_top = smaller(smaller(p.v, q.v), r.v), v_bottom = larger(larger(p.v, q.v), r.v);
    const FourDoubles left = columns.pixel(u_left), count = columns.pixel(u_right) - left;
    // The bound of largest_product.
    const FourDoubles first = left * columns.step;
    const FourDoubles x = larger(size_of(u_left - first), size_of(u_right - first)) + all(2) * columns.step;
    const FourDoubles y = v_bottom - v_top + rows.step;
    ordinary_ = marks(triangles) & bits_of(both(fits, is_at_most(all(4) * x * y, all(kLargestWhole))));

    first_column = numbers_of(left);
    column_count = numbers_of(count);
    const FourDoubles q_first = is_less(q.key, p.key);
    const GridPoints high = pick_points(q_first, q, p), low = pick_points(q_first, p, q);
    const FourDoubles r_before_high = is_less(r.key, high.key), r_before_low = is_less(r.key, low.key);
    set_corners(columns, rows, left, pick_points(r_before_high, r, high),
                pick_points(r_before_high, high, pick_points(r_before_low, r, low)),
                pick_points(r_before_low, low, r), is_equal(count, zero));
  }

  /// Whether the numbers of a triangle are of the size that is done here.
  [[nodiscard]] bool is_ordinary(std::size_t lane) const { return (ordinary_ >> lane & 1) != 0; }

  FourNumbers first_row;
  FourNumbers middle_row;
  FourNumbers end_row;
  FourNumbers first_column;
  FourNumbers column_count;
  // The corners a, b, c are sorted from the top.
  FourNumbers longest_is_left;  // a mask
  FourNumbers twice_total;      // of the weights
  FourNumbers is_flat;          // a mask: all of one depth
  FourNumbers a_z;
  FourNumbers b_z;
  FourNumbers c_z;
  FourNumbers half_slope;
  EdgeNumbers longest;  // a to c
  EdgeNumbers upper;    // a to b
  EdgeNumbers lower;    // b to c

 private:
  int ordinary_;  // a bit a triangle

  /// A vertex of each triangle; takes those out of `fits` for which it is too far away.
  PIPELINE_AVX2_INLINE static GridPoints point(const AxisLanes& columns, const AxisLanes& rows,
                                               const ColoredTriangle* triangles, std::size_t vertex,
                                               FourDoubles& fits) {
    const Vec3& p = triangles[0].triangle.p_ndc[vertex];
    const Vec3& q = triangles[1].triangle.p_ndc[vertex];
    const Vec3& r = triangles[2].triangle.p_ndc[vertex];
    const Vec3& s = triangles[3].triangle.p_ndc[vertex];
    const FourDoubles x = AxisLanes::units_of(_mm256_setr_pd(p.x, q.x, r.x, s.x));
    const FourDoubles y = AxisLanes::units_of(_mm256_setr_pd(p.y, q.y, r.y, s.y));
    fits = both(fits, both(columns.fits(x), rows.fits(y)));
    const FourDoubles u = columns.origin + columns.scaled(x), v = rows.origin - rows.scaled(y);
    const FourDoubles row = rows.pixel(v);
    return {u, v, _mm256_setr_pd(p.z, q.z, r.z, s.z), row, all(4) * row + all(static_cast<double>(vertex))};
  }
  /// A bit for each triangle whose x and y are decimals.
  static int marks(const ColoredTriangle* triangles) {
    int result = 0;
    for (std::size_t i = 0; i < kCount; ++i)
      result |= static_cast<int>(triangles[i].triangle.is_decimal()) << i;
    return result;
  }
  PIPELINE_AVX2_INLINE void set_corners(const AxisLanes& columns, const AxisLanes& rows, FourDoubles left,
                                        const GridPoints& a, const GridPoints& b, const GridPoints& c,
                                        FourDoubles is_between_columns) {
    const FourDoubles weight = (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
    const FourDoubles is_left = is_less(all(0), weight), sign = pick(is_left, all(1), all(-1));
    longest_is_left = numbers_of(is_left);
    set_depth(a.z, b.z, c.z, all(2) * sign * weight, sign * columns.step * (c.v - a.v),
              sign * columns.step * (a.v - b.v));

    first_row = numbers_of(a.row);
    middle_row = numbers_of(b.row);
    const FourDoubles is_empty = either(is_equal(weight, all(0)), is_between_columns);
    end_row = numbers_of(pick(is_empty, a.row, c.row));

    const FourDoubles first_u = left * columns.step, first_v = a.row * rows.step;
    const auto edge = [&](const GridPoints& from, const GridPoints& to) PIPELINE_AVX2 {
      const FourDoubles du = to.u - from.u, dv = to.v - from.v, column_step = columns.step * dv;
      return FourEdges{(from.u - first_u) * dv + (first_v - from.v) * du, rows.step * du, column_step,
                       all(1) / column_step};
    };
    longest = edge(a, c);
    upper = edge(a, b);
    lower = edge(b, c);
  }
  /// See PlainDepth.
  PIPELINE_AVX2_INLINE void set_depth(FourDoubles a, FourDoubles b, FourDoubles c, FourDoubles twice_weights,
                                      FourDoubles b_step, FourDoubles c_step) {
    const FourDoubles flat = both(is_equal(a, b), is_equal(a, c));
    const FourDoubles size = larger(larger(size_of(a), size_of(b)), size_of(c));
    const FourDoubles is_in_range = both(is_at_most(all(PlainDepth::kSmallestDepth), size),
                                         is_at_most(size, all(PlainDepth::kLargestDepth)));
    ordinary_ &= bits_of(either(flat, is_in_range));

    const FourSums of_two = two_sum(b_step * b, c_step * c);
    const FourSums of_three = two_sum(of_two.sum, (-b_step - c_step) * a);
    const FourDoubles slope =
        (of_three.sum + (of_two.lost + of_three.lost)) / twice_weights + all(PlainDepth::kNoMinus);
    half_slope = numbers_of(but_not(slope, flat));
    is_flat = numbers_of(flat);
    twice_total = numbers_of(twice_weights);
    a_z = numbers_of(a);
    b_z = numbers_of(b);
    c_z = numbers_of(c);
  }
};

/// Four neighbouring rows of a triangle.
struct FourRows {
  PIPELINE_AVX2_INLINE FourRows(const FourTriangles& t, std::size_t lane, double row) {
    const FourDoubles rows = all(row) + _mm256_setr_pd(0, 1, 2, 3);
    const FourDoubles is_upper = is_less(rows, all(t.middle_row[lane]));
    const FourDoubles row_count = rows - all(t.first_row[lane]);
    const FourDoubles most = all(t.column_count[lane]);
    const FourEdges longest = t.longest[lane], shorter = pick_edges(is_upper, t.upper[lane], t.lower[lane]);
    const FourDoubles longest_crossing = longest.crossing + row_count * longest.row_step;
    const FourDoubles shorter_crossing = shorter.crossing + row_count * shorter.row_step;
    const FourDoubles longest_pixel =
        quotient_rounded_up(longest_crossing, longest.column_step, longest.inverse, most);
    const FourDoubles shorter_pixel =
        quotient_rounded_up(shorter_crossing, shorter.column_step, shorter.inverse, most);
    const FourDoubles is_left = all(t.longest_is_left[lane]), left = all(t.first_column[lane]);
    const FourDoubles first = pick(is_left, longest_pixel, shorter_pixel);
    const FourDoubles last = pick(is_left, shorter_pixel, longest_pixel) - all(1);
    first_column = ints_of(left + first);
    last_column = ints_of(left + last);

    // The weights of the vertices opposite to the edges, at the first and at the last pixel added up.
    const FourDoubles sign = pick(is_left, all(1), all(-1));
    const FourDoubles opposite_longest =
        sign * ((first + last) * longest.column_step - all(2) * longest_crossing);
    const FourDoubles opposite_shorter =
        sign * (all(2) * shorter_crossing - (first + last) * shorter.column_step);
    const FourDoubles twice_total = all(t.twice_total[lane]);
    const FourDoubles rest = twice_total - opposite_longest - opposite_shorter;
    const FourDoubles twice_c = pick(is_upper, opposite_shorter, rest);
    const FourDoubles twice_a = pick(is_upper, rest, opposite_shorter);
    const FourDoubles a_z = all(t.a_z[lane]), b_z = all(t.b_z[lane]), c_z = all(t.c_z[lane]);
    const FourDoubles mean =
        ((opposite_longest * b_z + twice_c * c_z) + twice_a * a_z) / twice_total + all(PlainDepth::kNoMinus);
    columns_added_up = numbers_of(all(2) * left + (first + last));
    depth = numbers_of(pick(all(t.is_flat[lane]), a_z, mean));
  }

  FourInts first_column;
  FourInts last_column;
  FourNumbers columns_added_up;  // the first and the last
  FourNumbers depth;             // in the middle between them

 private:
  PIPELINE_AVX2_INLINE static FourEdges pick_edges(FourDoubles mask, const FourEdges& yes,
                                                   const FourEdges& no) {
    return {pick(mask, yes.crossing, no.crossing), pick(mask, yes.row_step, no.row_step),
            pick(mask, yes.column_step, no.column_step), pick(mask, yes.inverse, no.inverse)};
  }
};

/// As CoverageKernel says, for one of four triangles.
PIPELINE_AVX2 ColoredSpan* append_rows(const FourTriangles& four, std::size_t lane, Color color,
                                       const RowRange& rows, ColoredSpan* spans) {
  int row = std::max(rows.first, static_cast<int>(four.first_row[lane]));
  const int end = std::min(rows.end, static_cast<int>(four.end_row[lane]));
  while (row < end) {
    const FourRows some(four, lane, row);
    for (std::size_t i = 0; i < kCount && row < end; ++i, ++row) {
      const int first_column = some.first_column[i], last_column = some.last_column[i];
      // Member by member: as a whole it would be made elsewhere and copied.
      Span& span = spans->span;
      span.row = row;
      span.first_column = first_column;
      span.last_column = last_column;
      span.depth.left_x = 0;
      span.depth.dx = 2;
      span.depth.x0 = some.columns_added_up[i];
      span.depth.z0 = some.depth[i];
      span.depth.slope = four.half_slope[lane];
      spans->color = color;
      // Without a branch, as no processor could predict it.
      spans += static_cast<int>(first_column <= last_column);
    }
  }
  return spans;
}

}  // namespace

PIPELINE_AVX2 ColoredSpan* center_spans_avx2(const ExactGrid& grid,
                                             std::span<const ColoredTriangle> triangles, const RowRange& rows,
                                             ColoredSpan* spans) {
  const auto append_exactly = [&](const ColoredTriangle& triangle) {
    spans = append_spans(CenterRows(grid, triangle.triangle), triangle.color, rows, spans);
  };
  if (AxisLanes::is_small(grid.columns) && AxisLanes::is_small(grid.rows)) {
    const AxisLanes column_axis(grid.columns), row_axis(grid.rows);
    for (; triangles.size() >= kCount; triangles = triangles.subspan(kCount)) {
      const FourTriangles four(column_axis, row_axis, triangles.data());
      for (std::size_t lane = 0; lane < kCount; ++lane) {
        if (four.is_ordinary(lane))
          spans = append_rows(four, lane, triangles[lane].color, rows, spans);
        else
          append_exactly(triangles[lane]);
      }
    }
  }
  for (const ColoredTriangle& triangle : triangles) append_exactly(triangle);
  return spans;
}

}  // namespace pipeline

#endif
