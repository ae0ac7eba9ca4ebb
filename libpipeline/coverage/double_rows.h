// No include guard: included once for each target, see numbers/vector_targets.h.

#include "libpipeline/coverage/double_lanes.h"

PIPELINE_BEGIN_KERNELS();

#if HWY_TARGET != HWY_SCALAR

// The rule `center` for triangles of any doubles: where an edge crosses a row is calculated in doubles, with
// a bound on the error. Where that bound reaches a pixel's center, CenterRows decides.

/// No pair in pixels is off by more than that, relative to the largest.
constexpr double kPairDoubt = 0x1p-95;

/// A pixel, and where it is certain.
struct FirstPixels {
  Doubles pixel;
  Mask are_certain;
};

/// The first pixel at or after whole + rest, in [0, most]; `whole` is the nearest whole number.
HWY_INLINE FirstPixels first_pixel(Doubles whole, Doubles rest, Doubles doubt, Doubles most) {
  const Doubles pixel = whole + hn::IfThenElseZero(hn::Lt(all(0), rest), all(1));
  return {hn::Min(most, hn::Max(all(0), pixel)), hn::Lt(doubt, hn::Abs(rest))};
}

struct DoubleEdges {
  /// The first pixel at or after the edge on its row.
  HWY_INLINE FirstPixels cross(Doubles rows, Doubles column_count) const {
    // u is off by u 2^-53 at most, and the product by 7 * 2^-53 of itself.
    const Doubles shift = ((rows - v.hi) - v.lo) * slope, crossing = u + shift;
    const Doubles whole = hn::Round(crossing);
    return first_pixel(whole, crossing - whole, doubt + all(0x1p-50) * hn::Abs(shift), column_count);
  }

  // A corner, and du/dv.
  Doubles u;
  Pairs v;
  Doubles slope;
  Doubles doubt;
};

HWY_INLINE DoubleEdges choose(Mask mask, const DoubleEdges& yes, const DoubleEdges& no) {
  return {choose(mask, yes.u, no.u), choose(mask, yes.v, no.v), choose(mask, yes.slope, no.slope),
          choose(mask, yes.doubt, no.doubt)};
}

/// As RowSources.
struct DoubleRowSources {
  Doubles middle_row;
  Doubles end_row;
  Doubles column_count;
  Mask longest_is_left;
  DoubleEdges longest;
  DoubleEdges upper;
  DoubleEdges lower;
  Pairs corner;  // see DepthPlane
  Pairs per_column;
  Pairs per_row;
};

/// Some triangles prepared for their rows.
struct DoubleTriangleLanes {
  HWY_INLINE DoubleTriangleLanes(const PixelAxis& columns, const PixelAxis& rows,
                                 const TaggedTriangle* triangles, const RowRange& range) {
    std::array<std::uint64_t, kLanes> marks;
    for (std::size_t i = 0; i < kLanes; ++i) marks[i] = triangles[i].triangle.decimal_marks;
    constexpr hn::RebindToUnsigned<decltype(kDoubles)> kMarks;
    const auto all_marks = hn::LoadU(kMarks, marks.data());
    const Planes planes(columns, rows, vertices_of(triangles), [&](unsigned mark) HWY_ATTR {
      const auto bit = hn::Set(kMarks, std::uint64_t{1} << mark);
      return hn::RebindMask(kDoubles, hn::Eq(hn::And(all_marks, bit), bit));
    });
    sources.column_count = columns.count;
    sources.corner = planes.corner, sources.per_column = planes.per_column, sources.per_row = planes.per_row;
    half_slope = numbers_of(half_slope_of(planes.per_column));

    const Doubles slopes[3] = {(planes.r_u - planes.q_u).hi / (planes.r_v - planes.q_v).hi,
                               planes.r_u.hi / planes.r_v.hi, planes.q_u.hi / planes.q_v.hi};
    Mask are_certain = planes.are_certain;
    std::array<Corner, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [u, v, z] = planes.corners[i];
      const Doubles whole = hn::Round(v.hi), rest = (v.hi - whole) + v.lo;
      const auto row = first_pixel(whole, rest, all(kPairDoubt) * planes.size_v, rows.count);
      are_certain = hn::And(are_certain, row.are_certain);
      corners[i] = {row.pixel, u.hi, v, slopes[i]};
    }
    ordinary.bits = bits_of(are_certain);
    const Mask is_turned = sort(corners);
    sources.longest_is_left = hn::Xor(is_turned, hn::Lt(all(0), planes.area.hi));
    set_edges(corners, planes, all(0x1p-50) * planes.size_u);

    const auto& [p, q, r] = planes.corners;
    const Mask is_beside = hn::Or(hn::Lt(hn::Max(p.u.hi, hn::Max(q.u.hi, r.u.hi)), all(-0.5)),
                                  hn::Lt(columns.count, hn::Min(p.u.hi, hn::Min(q.u.hi, r.u.hi))));
    begin_row = hn::Max(all(range.first), corners[0].row);
    sources.middle_row = corners[1].row;
    sources.end_row = choose(is_beside, begin_row, hn::Min(all(range.end), corners[2].row));
  }

  HWY_INLINE Doubles end_row() const { return sources.end_row; }

  DoubleRowSources sources;
  Doubles begin_row;  // the first in the range
  LaneSet ordinary;   // triangles whose rows and depths are certain
  Numbers half_slope;

 private:
  struct Corner {
    Doubles row;  // the first at or below
    Doubles u;
    Pairs v;
    Doubles slope;  // of the opposite edge
  };
  HWY_INLINE static void swap_where(Mask mask, Corner& a, Corner& b) {
    const Corner kept = a;
    const auto chosen = [&](const Corner& yes, const Corner& no) HWY_ATTR {
      return Corner{choose(mask, yes.row, no.row), choose(mask, yes.u, no.u), choose(mask, yes.v, no.v),
                    choose(mask, yes.slope, no.slope)};
    };
    a = chosen(b, a);
    b = chosen(kept, b);
  }
  /// Sorts from the top; masks those whose winding that turns.
  HWY_INLINE static Mask sort(std::array<Corner, 3>& corners) {
    auto& [a, b, c] = corners;
    const Mask first = hn::Lt(b.row, a.row);
    swap_where(first, a, b);
    const Mask second = hn::Lt(c.row, b.row);
    swap_where(second, b, c);
    const Mask third = hn::Lt(b.row, a.row);
    swap_where(third, a, b);
    return hn::Xor(first, hn::Xor(second, third));
  }
  HWY_INLINE void set_edges(const std::array<Corner, 3>& corners, const Planes& planes, Doubles doubt_of_u) {
    const auto edge = [&](const Corner& from, Doubles slope) HWY_ATTR {
      return DoubleEdges{from.u, from.v, slope,
                         doubt_of_u + all(kPairDoubt) * planes.size_v * hn::Abs(slope)};
    };
    const auto& [a, b, c] = corners;
    sources.longest = edge(a, b.slope);
    sources.upper = edge(a, c.slope);
    sources.lower = edge(b, a.slope);
  }
};

/// A row of each of some triangles, or some rows of one.
struct DoubleRowLanes {
  DoubleRowLanes() = default;
  HWY_INLINE DoubleRowLanes(const DoubleRowSources& of, Doubles rows) : rows_(rows) {
    const auto shorter_edges = choose(hn::Lt(rows, of.middle_row), of.upper, of.lower);
    const FirstPixels longest = of.longest.cross(rows, of.column_count);
    const FirstPixels shorter = shorter_edges.cross(rows, of.column_count);
    const Doubles first = choose(of.longest_is_left, longest.pixel, shorter.pixel);
    const Doubles end = choose(of.longest_is_left, shorter.pixel, longest.pixel);
    const Mask is_there = hn::Lt(rows, of.end_row);
    spans.set_columns(rows, hn::IfThenElseZero(is_there, first), hn::IfThenElseZero(is_there, end) - all(1));
    columns_added_up_ = first + end - all(1);
    uncertain_ = hn::AndNot(hn::And(longest.are_certain, shorter.are_certain), is_there);
  }
  HWY_INLINE void set_depths(const DoubleRowSources& of) {
    spans.set_points(columns_added_up_,
                     middle_depth(of.corner, of.per_column, of.per_row, columns_added_up_, rows_));
  }
  [[nodiscard]] HWY_INLINE LaneSet ordinary() const { return {LaneSet::kAll & ~bits_of(uncertain_)}; }

  LaneSpans spans;

 private:
  Doubles rows_;
  Doubles columns_added_up_;  // the first and the last
  Mask uncertain_;
};

#endif

PIPELINE_END_KERNELS();
