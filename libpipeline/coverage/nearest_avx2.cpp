#include <array>

#include "libpipeline/coverage/append_four.h"
#include "libpipeline/coverage/four_doubles.h"
#include "libpipeline/coverage/four_points.h"
#include "libpipeline/coverage/four_spans.h"
#include "libpipeline/coverage/kernel.h"
#include "libpipeline/coverage/nearest.h"

#if defined(__x86_64__) && defined(__GNUC__)

namespace pipeline {
namespace {

// The same operations as in NearestRows, as long as neither a triangle nor a row is out of the ordinary: no
// product near the ends of a double's range, no corner on the line of pixel centers.

PIPELINE_AVX2_INLINE FourPoints pick_points(FourDoubles mask, const FourPoints& yes, const FourPoints& no) {
  return {pick(mask, yes.x, no.x), pick(mask, yes.y, no.y), pick(mask, yes.z, no.z)};
}
PIPELINE_AVX2_INLINE FourPoints operator-(const FourPoints& a, const FourPoints& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// By y, then x, then z.
PIPELINE_AVX2_INLINE FourDoubles is_lower(const FourPoints& a, const FourPoints& b) {
  const FourDoubles by_x = either(is_less(a.x, b.x), both(is_equal(a.x, b.x), is_less(a.z, b.z)));
  return either(is_less(a.y, b.y), both(is_equal(a.y, b.y), by_x));
}

/// The numbers from which the rows of four triangles are calculated, or those of one, four times.
struct RowSources {
  PIPELINE_AVX2_INLINE RowSources of(std::size_t lane) const {
    return {lowest.of(lane),  middle.of(lane),       highest.of(lane),
            all(slope[lane]), all(is_edge_on[lane]), all(last_row[lane])};
  }

  FourPoints lowest;
  FourPoints middle;
  FourPoints highest;
  FourDoubles slope;
  FourDoubles is_edge_on;  // a mask
  FourDoubles last_row;
};

/// Four triangles prepared for their rows.
struct FourTriangles {
  PIPELINE_AVX2_INLINE FourTriangles(const PixelGrid& grid, const TaggedTriangle* triangles,
                                     const RowRange& rows) {
    const auto [a, b, c] = vertices_of(triangles);
    const FourDoubles b_first = is_lower(b, a), c_before_a = is_lower(c, a), c_before_b = is_lower(c, b);
    const FourPoints low = pick_points(b_first, b, a), high = pick_points(b_first, a, b);
    const FourDoubles c_before_low = pick(b_first, c_before_b, c_before_a);
    const FourDoubles c_before_high = pick(b_first, c_before_a, c_before_b);
    set_corners(grid, pick_points(c_before_low, c, low),
                pick_points(c_before_low, low, pick_points(c_before_high, c, high)),
                pick_points(c_before_high, high, c));
    begin_row = larger(begin_row, all(rows.first));
    sources.last_row = smaller(sources.last_row, all(rows.end) - all(1));
  }

  PIPELINE_AVX2_INLINE FourDoubles end_row() const { return sources.last_row + all(1); }

  RowSources sources;
  FourDoubles begin_row;  // the first in the range
  LaneSet ordinary;       // triangles whose numbers all stay in the range of this arithmetic

 private:
  PIPELINE_AVX2_INLINE void set_corners(const PixelGrid& grid, const FourPoints& p, const FourPoints& q,
                                        const FourPoints& r) {
    sources.lowest = p;
    sources.middle = q;
    sources.highest = r;
    const FourDoubles top = (all(grid.top_y) - r.y) / all(grid.dy);
    const FourDoubles bottom = (all(grid.top_y) - p.y) / all(grid.dy);
    begin_row = _mm256_ceil_pd(clamped(top, 0, grid.rows));
    sources.last_row = _mm256_floor_pd(clamped(bottom, -1, grid.rows - 1));
    set_slope(grid, q - p, r - p, size_of(p.z) + size_of(q.z) + size_of(r.z));
  }
  /// From the edges that leave the lowest corner.
  PIPELINE_AVX2_INLINE void set_slope(const PixelGrid& grid, const FourPoints& b, const FourPoints& c,
                                      FourDoubles size) {
    const FourDoubles forward = b.x * c.y, backward = c.x * b.y;
    const FourDoubles rise = b.z * c.y - c.z * b.y;
    const FourDoubles area = forward - backward, terms = size_of(forward) + size_of(backward);
    const FourDoubles has_no_slope = is_at_most(size_of(area), all(NearestRows::kAreaError) * terms);
    const FourDoubles slopes = but_not(rise / area, has_no_slope);
    sources.slope = slopes;
    sources.is_edge_on = has_no_slope;
    const FourDoubles reach = size_of(b.x) + size_of(c.x);
    const FourDoubles rise_in_y = b.x * c.z - c.x * b.z;
    const FourDoubles change =
        size_of(rise) * (all(grid.half_width) + reach) + size_of(rise_in_y) * (all(grid.half_height) + c.y);
    const FourDoubles net_area = size_of(area) - all(NearestRows::kNarrowest) * terms -
                                 all(NearestRows::kNarrowestRow * grid.dx) * c.y;
    const FourDoubles huge = all(NearestRows::kHuge);
    const FourDoubles limit = smaller(all(NearestRows::kSteepest) * size * net_area, huge);
    const FourDoubles is_good = is_at_most(change, pick(has_no_slope, huge, limit));
    const FourDoubles is_in_range = both(is_less(all(0x1p-900), terms), is_less(terms, all(0x1p900)));
    const FourDoubles largest = larger(reach + (size_of(b.z) + size_of(c.z)), size_of(slopes));
    const FourDoubles is_finite = is_less(largest, huge);
    ordinary.bits = bits_of(both(both(is_good, is_in_range), is_finite));
  }
};

/// A row of each of four triangles, or four rows of one.
struct FourRows {
  FourRows() = default;
  PIPELINE_AVX2_INLINE FourRows(const PixelGrid& grid, const RowSources& of, FourDoubles rows) {
    const FourDoubles y = all(grid.top_y) - rows * all(grid.dy);
    // The longest edge and, below or above the middle corner, one of the others.
    const FourDoubles is_upper = is_less(of.middle.y, y);
    const FourPoints first = intersection(pick_points(is_upper, of.middle, of.lowest),
                                          pick_points(is_upper, of.highest, of.middle), y);
    const FourPoints second = intersection(of.lowest, of.highest, y);
    const FourDoubles is_lower_z = both(is_equal(second.x, first.x), is_less(second.z, first.z));
    const FourPoints left = pick_points(either(is_less(second.x, first.x), is_lower_z), second, first);
    const FourPoints right = pick_points(either(is_less(first.x, second.x), is_lower_z), second, first);
    const FourDoubles left_column = (left.x - all(grid.left_x)) / all(grid.dx) + all(0.5);
    const FourDoubles right_column = (right.x - all(grid.left_x)) / all(grid.dx) + all(0.5);
    const FourDoubles is_there = is_at_most(rows, of.last_row);
    spans.set_columns(rows, both(is_there, _mm256_floor_pd(clamped(left_column, 0, grid.columns))),
                      pick(is_there, _mm256_floor_pd(clamped(right_column, -1, grid.columns - 1)), all(-1)));

    const FourDoubles is_slanted = but_not(is_less(left.x, right.x), of.is_edge_on);
    spans.set_points(left.x, pick(is_slanted, left.z, smaller(left.z, right.z)));
    slope = numbers_of(both(is_slanted, of.slope));
    const FourDoubles is_between = both(is_less(of.lowest.y, y), is_less(y, of.highest.y));
    const FourDoubles is_at_corner = but_not(is_there, but_not(is_between, is_equal(y, of.middle.y)));
    ordinary_.bits = LaneSet::kAll & ~bits_of(is_at_corner);
  }
  /// Depths are set with the columns.
  void set_depths(const RowSources&) {}

  /// The rows without a corner on their line of pixel centers.
  [[nodiscard]] LaneSet ordinary() const { return ordinary_; }

  FourSpans spans;
  FourNumbers slope;

 private:
  LaneSet ordinary_;

  PIPELINE_AVX2_INLINE static FourPoints intersection(const FourPoints& lower, const FourPoints& upper,
                                                      FourDoubles y) {
    const FourPoints edge = upper - lower;
    const FourDoubles t = (y - lower.y) / edge.y;
    return {lower.x + t * edge.x, y, lower.z + t * edge.z};
  }
};

/// The rule `nearest` for append_four.h.
struct Rule {
  using FourRows = pipeline::FourRows;
  [[nodiscard]] NearestRows rows(const TaggedTriangle& triangle) const {
    return {grid, triangle.triangle.p_ndc};
  }
  PIPELINE_AVX2_INLINE FourTriangles four(const TaggedTriangle* triangles, const RowRange& range) const {
    return {grid, triangles, range};
  }
  PIPELINE_AVX2_INLINE FourRows four_rows(const RowSources& sources, FourDoubles rows) const {
    return {grid, sources, rows};
  }
  static double slope(const FourTriangles&, std::size_t, const FourRows& rows, std::size_t row) {
    return rows.slope[row];
  }
  PIPELINE_AVX2_INLINE __m128d axis() const { return _mm_setr_pd(grid.left_x, grid.dx); }

  const PixelGrid& grid;
};

}  // namespace

PIPELINE_AVX2 TaggedSpan* nearest_spans_avx2(const PixelGrid& grid, std::span<const TaggedTriangle> triangles,
                                             const RowRange& rows, TaggedSpan* spans) {
  return append_four_by_four(Rule{grid}, triangles, rows, spans);
}

}  // namespace pipeline

#endif
