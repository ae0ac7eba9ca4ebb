
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/nearest.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/coverage/nearest_kernel.cpp"
#include "libpipeline/coverage/triangle_lanes.h"

PIPELINE_BEGIN_KERNELS();

#if HWY_TARGET != HWY_SCALAR

// The operations of NearestRows for ordinary triangles and rows: no product is near the ends of a double's
// range, no corner on the line of pixel centers.

HWY_INLINE Doubles clamped(Doubles value, double low, double high) {
  return hn::Min(all(high), hn::Max(all(low), value));
}

/// The order by y, then x, then z.
HWY_INLINE Mask is_lower(const Vectors& a, const Vectors& b) {
  const Mask by_x = hn::Or(hn::Lt(a.x, b.x), hn::And(hn::Eq(a.x, b.x), hn::Lt(a.z, b.z)));
  return hn::Or(hn::Lt(a.y, b.y), hn::And(hn::Eq(a.y, b.y), by_x));
}

/// The numbers from which rows are calculated: of some triangles, or of one in all lanes.
struct RowSources {
  Vectors lowest;
  Vectors middle;
  Vectors highest;
  Doubles slope;
  Mask is_edge_on;
  Doubles last_row;
};

/// Some triangles prepared for their rows.
struct TriangleLanes {
  HWY_INLINE TriangleLanes(const PixelGrid& grid, const TaggedTriangle* triangles, const RowRange& rows) {
    const auto [a, b, c] = vertices_of(triangles);
    const Mask b_first = is_lower(b, a), c_before_a = is_lower(c, a), c_before_b = is_lower(c, b);
    const Mask c_first = hn::And(c_before_a, c_before_b), c_not_last = hn::Or(c_before_a, c_before_b);
    const Vectors low = choose(b_first, b, a), high = choose(b_first, a, b);
    set_corners(grid, choose(c_first, c, low), choose(c_first, low, choose(c_not_last, c, high)),
                choose(c_not_last, high, c));
    begin_row = hn::Max(all(rows.first), begin_row);
    sources.last_row = hn::Min(all(rows.end) - all(1), sources.last_row);
  }

  HWY_INLINE Doubles end_row() const { return sources.last_row + all(1); }

  RowSources sources;
  Doubles begin_row;  // the first row in the range
  LaneSet ordinary;   // triangles whose numbers stay in this arithmetic's range

 private:
  HWY_INLINE void set_corners(const PixelGrid& grid, const Vectors& p, const Vectors& q, const Vectors& r) {
    sources.lowest = p;
    sources.middle = q;
    sources.highest = r;
    const Doubles top = (all(grid.top_y) - r.y) / all(grid.dy);
    const Doubles bottom = (all(grid.top_y) - p.y) / all(grid.dy);
    begin_row = hn::Ceil(clamped(top, 0, grid.rows));
    sources.last_row = hn::Floor(clamped(bottom, -1, grid.rows - 1));
    set_slope(grid, q - p, r - p, hn::Abs(p.z) + hn::Abs(q.z) + hn::Abs(r.z));
  }
  /// Sets the slope from the edges at the lowest corner.
  HWY_INLINE void set_slope(const PixelGrid& grid, const Vectors& b, const Vectors& c, Doubles size) {
    const Doubles forward = b.x * c.y, backward = c.x * b.y;
    const Doubles rise = b.z * c.y - c.z * b.y;
    const Doubles area = forward - backward, terms = hn::Abs(forward) + hn::Abs(backward);
    const Mask has_no_slope = hn::Le(hn::Abs(area), all(NearestRows::kAreaError) * terms);
    const Doubles slopes = hn::IfThenZeroElse(has_no_slope, rise / area);
    sources.slope = slopes;
    sources.is_edge_on = has_no_slope;
    const Doubles reach = hn::Abs(b.x) + hn::Abs(c.x);
    const Doubles rise_in_y = b.x * c.z - c.x * b.z;
    const Doubles change =
        hn::Abs(rise) * (all(grid.half_width) + reach) + hn::Abs(rise_in_y) * (all(grid.half_height) + c.y);
    const Doubles net_area = hn::Abs(area) - all(NearestRows::kNarrowest) * terms -
                             all(NearestRows::kNarrowestRow * grid.dx) * c.y;
    const Doubles huge = all(NearestRows::kHuge);
    const Doubles limit = hn::Min(huge, all(NearestRows::kSteepest) * size * net_area);
    const Mask is_good = hn::Le(change, choose(has_no_slope, huge, limit));
    const Mask is_in_range = hn::And(hn::Lt(all(0x1p-900), terms), hn::Lt(terms, all(0x1p900)));
    const Doubles largest = hn::Max(hn::Abs(slopes), reach + (hn::Abs(b.z) + hn::Abs(c.z)));
    const Mask is_finite = hn::Lt(largest, huge);
    ordinary.bits = bits_of(hn::And(hn::And(is_good, is_in_range), is_finite));
  }
};

/// One row each of some triangles, or some rows of one triangle.
struct RowLanes {
  RowLanes() = default;
  HWY_INLINE RowLanes(const PixelGrid& grid, const RowSources& of, Doubles rows) {
    const Doubles y = all(grid.top_y) - rows * all(grid.dy);
    // The longest edge and, below or above the middle corner, one of the others.
    const Mask is_upper = hn::Lt(of.middle.y, y);
    const Vectors first =
        intersection(choose(is_upper, of.middle, of.lowest), choose(is_upper, of.highest, of.middle), y);
    const Vectors second = intersection(of.lowest, of.highest, y);
    const Mask is_lower_z = hn::And(hn::Eq(second.x, first.x), hn::Lt(second.z, first.z));
    const Vectors left = choose(hn::Or(hn::Lt(second.x, first.x), is_lower_z), second, first);
    const Vectors right = choose(hn::Or(hn::Lt(first.x, second.x), is_lower_z), second, first);
    const Doubles left_column = (left.x - all(grid.left_x)) / all(grid.dx) + all(0.5);
    const Doubles right_column = (right.x - all(grid.left_x)) / all(grid.dx) + all(0.5);
    const Mask is_there = hn::Le(rows, of.last_row);
    spans.set_columns(rows, hn::IfThenElseZero(is_there, hn::Floor(clamped(left_column, 0, grid.columns))),
                      choose(is_there, hn::Floor(clamped(right_column, -1, grid.columns - 1)), all(-1)));

    const Mask is_slanted = hn::AndNot(of.is_edge_on, hn::Lt(left.x, right.x));
    spans.set_points(left.x, choose(is_slanted, left.z, choose(hn::Lt(right.z, left.z), right.z, left.z)));
    slope = numbers_of(hn::IfThenElseZero(is_slanted, of.slope));
    const Mask is_between = hn::And(hn::Lt(of.lowest.y, y), hn::Lt(y, of.highest.y));
    const Mask is_at_corner = hn::AndNot(hn::AndNot(hn::Eq(y, of.middle.y), is_between), is_there);
    ordinary_.bits = LaneSet::kAll & ~bits_of(is_at_corner);
  }
  /// Does nothing: depths are set with the columns.
  void set_depths(const RowSources&) {}

  /// The rows without a corner on their line of pixel centers.
  [[nodiscard]] LaneSet ordinary() const { return ordinary_; }

  LaneSpans spans;
  Numbers slope;

 private:
  LaneSet ordinary_;

  HWY_INLINE static Vectors intersection(const Vectors& lower, const Vectors& upper, Doubles y) {
    const Vectors edge = upper - lower;
    const Doubles t = (y - lower.y) / edge.y;
    return {lower.x + t * edge.x, y, lower.z + t * edge.z};
  }
};

/// The rule `nearest` for triangle_lanes.h.
struct Rule {
  using RowLanes = HWY_NAMESPACE::RowLanes;
  [[nodiscard]] NearestRows rows(const TaggedTriangle& triangle) const {
    return {grid, triangle.triangle.p_ndc};
  }
  HWY_INLINE TriangleLanes prepared(const TaggedTriangle* triangles, const RowRange& range) const {
    return {grid, triangles, range};
  }
  HWY_INLINE RowLanes some_rows(const RowSources& sources, Doubles rows) const {
    return {grid, sources, rows};
  }
  static double slope(const TriangleLanes&, std::size_t, const RowLanes& rows, std::size_t row) {
    return rows.slope[row];
  }
  [[nodiscard]] Axis axis() const { return {grid.left_x, grid.dx}; }

  const PixelGrid& grid;
};

#endif

TaggedSpan* nearest_spans(const PixelGrid& grid, std::span<const TaggedTriangle> triangles,
                          const RowRange& rows, TaggedSpan* spans) {
#if HWY_TARGET != HWY_SCALAR
  const Rule rule{grid};
  for (; triangles.size() >= kLanes; triangles = triangles.subspan(kLanes))
    spans = append_triangles(rule, rule.prepared(triangles.data(), rows), triangles.data(), rows, spans);
#endif
  for (const auto& [triangle, tag] : triangles)
    spans = append_spans(NearestRows(grid, triangle.p_ndc), tag, rows, spans);
  return spans;
}

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {

constinit const KernelTable<NearestSpans> kNearestKernels = PIPELINE_KERNEL_TABLE(nearest_spans);

}  // namespace pipeline

#endif
