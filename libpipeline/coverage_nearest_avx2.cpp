#include <algorithm>

#include "libpipeline/coverage_avx2.h"
#include "libpipeline/coverage_nearest.h"
#include "libpipeline/four_doubles.h"

#if defined(__x86_64__) && defined(__GNUC__)

namespace pipeline {
namespace {

constexpr std::size_t kCount = 4;

// What NearestRows does, in the same operations, as long as neither a triangle nor a row is out of the
// ordinary: no product near the ends of a double's range, no corner on the line of pixel centres.

struct FourPoints {
  FourDoubles x;
  FourDoubles y;
  FourDoubles z;
};

/// The same, each on its own.
struct PointNumbers {
  PIPELINE_AVX2_INLINE PointNumbers& operator=(const FourPoints& p) {
    x = numbers_of(p.x);
    y = numbers_of(p.y);
    z = numbers_of(p.z);
    return *this;
  }
  /// One of them, four times.
  PIPELINE_AVX2_INLINE FourPoints operator[](std::size_t lane) const {
    return {all(x[lane]), all(y[lane]), all(z[lane])};
  }

  FourNumbers x;
  FourNumbers y;
  FourNumbers z;
};

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

/// A vertex of each of four triangles.
PIPELINE_AVX2_INLINE FourPoints vertices(const ColoredTriangle* triangles, std::size_t vertex) {
  const Vec3& p = triangles[0].triangle.p_ndc[vertex];
  const Vec3& q = triangles[1].triangle.p_ndc[vertex];
  const Vec3& r = triangles[2].triangle.p_ndc[vertex];
  const Vec3& s = triangles[3].triangle.p_ndc[vertex];
  return {_mm256_setr_pd(p.x, q.x, r.x, s.x), _mm256_setr_pd(p.y, q.y, r.y, s.y),
          _mm256_setr_pd(p.z, q.z, r.z, s.z)};
}

/// Four triangles made ready for their rows.
struct FourTriangles {
  PIPELINE_AVX2_INLINE FourTriangles(const PixelGrid& grid, const ColoredTriangle* triangles) {
    const FourPoints a = vertices(triangles, 0), b = vertices(triangles, 1), c = vertices(triangles, 2);
    const FourDoubles b_first = is_lower(b, a), c_before_a = is_lower(c, a), c_before_b = is_lower(c, b);
    const FourPoints low = pick_points(b_first, b, a), high = pick_points(b_first, a, b);
    const FourDoubles c_before_low = pick(b_first, c_before_b, c_before_a);
    const FourDoubles c_before_high = pick(b_first, c_before_a, c_before_b);
    set_corners(grid, pick_points(c_before_low, c, low),
                pick_points(c_before_low, low, pick_points(c_before_high, c, high)),
                pick_points(c_before_high, high, c));
  }

  /// Whether a triangle can be done here.
  [[nodiscard]] bool is_ordinary(std::size_t lane) const { return (ordinary_ >> lane & 1) != 0; }

  PointNumbers lowest;
  PointNumbers middle;
  PointNumbers highest;
  FourNumbers slope;
  FourNumbers is_edge_on;  // a mask
  FourInts first_row;
  FourInts last_row;

 private:
  int ordinary_;  // a bit a triangle

  PIPELINE_AVX2_INLINE void set_corners(const PixelGrid& grid, const FourPoints& p, const FourPoints& q,
                                        const FourPoints& r) {
    lowest = p;
    middle = q;
    highest = r;
    const FourDoubles top = (all(grid.top_y) - r.y) / all(grid.dy);
    const FourDoubles bottom = (all(grid.top_y) - p.y) / all(grid.dy);
    first_row = ints_of(_mm256_ceil_pd(clamped(top, 0, grid.rows)));
    last_row = ints_of(_mm256_floor_pd(clamped(bottom, -1, grid.rows - 1)));
    set_slope(q - p, r - p);
  }
  /// From the edges that leave the lowest corner.
  PIPELINE_AVX2_INLINE void set_slope(const FourPoints& b, const FourPoints& c) {
    constexpr double kHuge = 0x1p1000;
    const FourDoubles forward = b.x * c.y, backward = c.x * b.y;
    const FourDoubles rise = b.z * c.y - c.z * b.y;
    const FourDoubles area = forward - backward, terms = size_of(forward) + size_of(backward);
    const FourDoubles has_no_slope = is_at_most(size_of(area), all(NearestRows::kAreaError) * terms);
    const FourDoubles slopes = but_not(rise / area, has_no_slope);
    slope = numbers_of(slopes);
    is_edge_on = numbers_of(has_no_slope);
    const FourDoubles reach = size_of(b.x) + size_of(c.x) + size_of(b.z) + size_of(c.z);
    const FourDoubles is_in_range = both(is_less(all(0x1p-900), terms), is_less(terms, all(0x1p900)));
    const FourDoubles is_finite = both(is_less(reach, all(kHuge)), is_less(size_of(rise), all(kHuge)));
    ordinary_ = bits_of(both(both(is_in_range, is_finite), is_less(size_of(slopes), all(kHuge))));
  }
};

/// Four neighbouring rows of a triangle.
struct FourRows {
  PIPELINE_AVX2_INLINE FourRows(const PixelGrid& grid, const FourTriangles& triangles, std::size_t lane,
                                int row) {
    const FourPoints lowest = triangles.lowest[lane];
    const FourPoints middle = triangles.middle[lane];
    const FourPoints highest = triangles.highest[lane];
    const FourDoubles y = all(grid.top_y) - (all(row) + _mm256_setr_pd(0, 1, 2, 3)) * all(grid.dy);
    // The longest edge and, below or above the middle corner, one of the others.
    const FourDoubles is_upper = is_less(middle.y, y);
    const FourPoints first =
        intersection(pick_points(is_upper, middle, lowest), pick_points(is_upper, highest, middle), y);
    const FourPoints second = intersection(lowest, highest, y);
    const FourDoubles is_lower_z = both(is_equal(second.x, first.x), is_less(second.z, first.z));
    const FourPoints left = pick_points(either(is_less(second.x, first.x), is_lower_z), second, first);
    const FourPoints right = pick_points(either(is_less(first.x, second.x), is_lower_z), second, first);
    const FourDoubles left_column = (left.x - all(grid.left_x)) / all(grid.dx) + all(0.5);
    const FourDoubles right_column = (right.x - all(grid.left_x)) / all(grid.dx) + all(0.5);
    first_column = ints_of(_mm256_floor_pd(clamped(left_column, 0, grid.columns)));
    last_column = ints_of(_mm256_floor_pd(clamped(right_column, -1, grid.columns - 1)));

    const FourDoubles is_slanted = but_not(is_less(left.x, right.x), all(triangles.is_edge_on[lane]));
    x0 = numbers_of(left.x);
    z0 = numbers_of(pick(is_slanted, left.z, smaller(left.z, right.z)));
    slope = numbers_of(both(is_slanted, all(triangles.slope[lane])));
    const FourDoubles is_between = both(is_less(lowest.y, y), is_less(y, highest.y));
    ordinary_ = bits_of(but_not(is_between, is_equal(y, middle.y)));
  }

  /// Whether a row can be done here.
  [[nodiscard]] bool is_ordinary(std::size_t lane) const { return (ordinary_ >> lane & 1) != 0; }

  FourInts first_column;
  FourInts last_column;
  FourNumbers x0;
  FourNumbers z0;
  FourNumbers slope;

 private:
  int ordinary_;  // a bit a row

  PIPELINE_AVX2_INLINE static FourPoints intersection(const FourPoints& lower, const FourPoints& upper,
                                                      FourDoubles y) {
    const FourPoints edge = upper - lower;
    const FourDoubles t = (y - lower.y) / edge.y;
    return {lower.x + t * edge.x, y, lower.z + t * edge.z};
  }
};

/// What NearestRows has on these rows.
ColoredSpan* append_one_by_one(const PixelGrid& grid, const ColoredTriangle& triangle, const RowRange& rows,
                               ColoredSpan* spans) {
  return append_spans(NearestRows(grid, triangle.triangle.p_ndc), triangle.color, rows, spans);
}

/// As CoverageKernel says, for one of four triangles.
PIPELINE_AVX2 ColoredSpan* append_rows(const PixelGrid& grid, const FourTriangles& four, std::size_t lane,
                                       const ColoredTriangle& triangle, const RowRange& rows,
                                       ColoredSpan* spans) {
  const int end = std::min(rows.end, four.last_row[lane] + 1);
  for (int row = std::max(rows.first, four.first_row[lane]); row < end;) {
    const FourRows some(grid, four, lane, row);
    for (std::size_t i = 0; i < kCount && row < end; ++i, ++row) {
      if (!some.is_ordinary(i)) {
        spans = append_one_by_one(grid, triangle, {row, row + 1}, spans);
        continue;
      }
      const int first_column = some.first_column[i], last_column = some.last_column[i];
      // Member by member: as a whole it would be made elsewhere and copied.
      Span& span = spans->span;
      span.row = row;
      span.first_column = first_column;
      span.last_column = last_column;
      span.depth.left_x = grid.left_x;
      span.depth.dx = grid.dx;
      span.depth.x0 = some.x0[i];
      span.depth.z0 = some.z0[i];
      span.depth.slope = some.slope[i];
      spans->color = triangle.color;
      // Without a branch, as no processor could predict it.
      spans += static_cast<int>(first_column <= last_column);
    }
  }
  return spans;
}

}  // namespace

PIPELINE_AVX2 ColoredSpan* nearest_spans_avx2(const PixelGrid& grid,
                                              std::span<const ColoredTriangle> triangles,
                                              const RowRange& rows, ColoredSpan* spans) {
  for (; triangles.size() >= kCount; triangles = triangles.subspan(kCount)) {
    const FourTriangles four(grid, triangles.data());
    for (std::size_t lane = 0; lane < kCount; ++lane) {
      if (four.is_ordinary(lane))
        spans = append_rows(grid, four, lane, triangles[lane], rows, spans);
      else
        spans = append_one_by_one(grid, triangles[lane], rows, spans);
    }
  }
  for (const ColoredTriangle& triangle : triangles) spans = append_one_by_one(grid, triangle, rows, spans);
  return spans;
}

}  // namespace pipeline

#endif
