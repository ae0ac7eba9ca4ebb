// No include guard: included once for each target, see numbers/vector_targets.h.

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/triangle_depth.h"
#include "libpipeline/coverage/triangle_lanes.h"

PIPELINE_BEGIN_KERNELS();

// Triangles with any doubles as coordinates, also mixed with decimals: their positions in pixels, their
// planes, and the pixels that they certainly cover.

/// Triangles with larger numbers are left to CenterRows.
constexpr double kMaxPixel = 0x1p50;

/// One direction of the grid, in all lanes.
struct PixelAxis {
  HWY_INLINE explicit PixelAxis(const GridAxis& axis)
      : per_unit(all(axis.pixels_per_unit)), middle(all(0.5 * (axis.count - 1))), count(all(axis.count)) {}

  /// Positions in units of the seventh decimal; whole numbers for decimals, which `is_decimal` masks.
  HWY_INLINE static Pairs units(Doubles coordinate, Mask is_decimal) {
    const Pairs product = two_product(coordinate, all(kGridUnitsPerOne));
    return {choose(is_decimal, hn::Round(product.hi), product.hi),
            hn::IfThenZeroElse(is_decimal, product.lo)};
  }

  Pairs per_unit;
  Doubles middle;
  Doubles count;
};

/// The corners of some triangles, in pixels from the center of pixel 0.
struct PixelPoints {
  Pairs u;  // to the right
  Pairs v;  // down
  Doubles z;
};

/// The planes of some triangles with any doubles: the numbers that DepthPlane has for one.
struct Planes {
  /// `decimal(k)` masks the coordinates with mark k (ExactTriangle).
  template <typename Decimal>
  HWY_INLINE Planes(const PixelAxis& columns, const PixelAxis& rows, const std::array<Vectors, 3>& p_ndc,
                    const Decimal& decimal) {
    Doubles fits = all(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const unsigned mark = 3 * static_cast<unsigned>(i);
      const Pairs x = PixelAxis::units(p_ndc[i].x, decimal(mark));
      const Pairs y = PixelAxis::units(p_ndc[i].y, decimal(mark + 1));
      const Pairs right = x * columns.per_unit, up = y * rows.per_unit;
      corners[i] = {Pairs{columns.middle, all(0)} + right, Pairs{rows.middle, all(0)} - up, p_ndc[i].z};
      // A NaN remains in the sum.
      fits = fits + (hn::Abs(x.hi) + hn::Abs(y.hi));
    }
    const auto& [p, q, r] = corners;
    size_u = hn::Abs(p.u.hi) + hn::Abs(q.u.hi) + hn::Abs(r.u.hi) + columns.count;
    size_v = hn::Abs(p.v.hi) + hn::Abs(q.v.hi) + hn::Abs(r.v.hi) + rows.count;
    q_u = q.u - p.u, q_v = q.v - p.v, r_u = r.u - p.u, r_v = r.v - p.v;
    area = q_u * r_v - q_v * r_u;

    const Pairs q_z = two_sum(q.z, hn::Neg(p.z)), r_z = two_sum(r.z, hn::Neg(p.z));
    per_column = (q_z * r_v - r_z * q_v) / area;
    per_row = (q_u * r_z - r_u * q_z) / area;
    corner = Pairs{p.z, all(0)} - (per_column * p.u + per_row * p.v);

    // The hypotheses of tests/proofs/depth_in_planes.g.
    const Doubles width = hn::Abs(q_u.hi) + hn::Abs(r_u.hi), height = hn::Abs(q_v.hi) + hn::Abs(r_v.hi);
    const Doubles most = all(0x1p36) * area.hi * area.hi;
    const Doubles depth = hn::Max(hn::Abs(p.z), hn::Max(hn::Abs(q.z), hn::Abs(r.z)));
    const Mask is_flat = hn::And(hn::Eq(p.z, q.z), hn::Eq(p.z, r.z));
    are_certain =
        hn::And(hn::And(hn::Le(fits, all(kMaxExactDouble)), hn::Le(size_u + size_v, all(kMaxPixel))),
                hn::And(hn::Lt(width * height * (size_u * height + size_v * width), most),
                        hn::Or(is_flat, hn::And(hn::Le(all(0x1p-400), depth), hn::Le(depth, all(0x1p400))))));
  }

  std::array<PixelPoints, 3> corners;
  Pairs q_u, q_v, r_u, r_v;  // the second and the third corner, from the first
  Pairs area;                // twice the signed area
  Doubles size_u, size_v;    // no number in pixels is larger
  Pairs corner, per_column, per_row;
  Mask are_certain;
};

/// The depth halfway between two columns whose sum is `columns_added_up`.
HWY_INLINE Doubles middle_depth(const Pairs& corner, const Pairs& per_column, const Pairs& per_row,
                                Doubles columns_added_up, Doubles rows) {
  return ((corner + per_column * (all(0.5) * columns_added_up)) + per_row * rows).hi +
         all(DepthInDoubles::kNoMinus);
}
/// The slope per half column.
HWY_INLINE Doubles half_slope_of(const Pairs& per_column) {
  return all(0.5) * per_column.hi + all(DepthInDoubles::kNoMinus);
}

#if HWY_TARGET != HWY_SCALAR

// The rule `center` for triangles with any doubles. An edge's crossing with a row is calculated in doubles,
// with an error bound; if this reaches a pixel's center, CenterRows decides.

/// A bound on the error of every pair in pixels, relative to the largest.
constexpr double kPairDoubt = 0x1p-95;

/// Pixels, and the lanes where they are certain.
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
    // u is off by at most 2^-53 of itself, the product by at most 7 * 2^-53 of itself.
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

/// The RowSources (center_kernel.cpp) of such triangles.
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
  Doubles begin_row;  // the first row in the range
  LaneSet ordinary;   // triangles whose rows and depths are certain
  Numbers half_slope;

 private:
  struct Corner {
    Doubles row;  // the first row at or below the corner
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
  /// Sorts corners from the top; masks the triangles whose winding this flips.
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

/// One row each of some triangles, or some rows of one triangle.
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
  Doubles columns_added_up_;  // the sum of the first and the last
  Mask uncertain_;
};

#endif

PIPELINE_END_KERNELS();
