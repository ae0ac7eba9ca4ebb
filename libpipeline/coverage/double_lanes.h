// No include guard: included once for each target, see numbers/vector_targets.h.

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/triangle_depth.h"
#include "libpipeline/coverage/triangle_lanes.h"

PIPELINE_BEGIN_KERNELS();

// Triangles of any doubles, mixed with decimals: their positions in pixels, their planes, and which pixels
// they cover, where that is certain.

/// Numbers beyond that are left to CenterRows.
constexpr double kMaxPixel = 0x1p50;

/// A direction of the grid, in all lanes.
struct PixelAxis {
  HWY_INLINE explicit PixelAxis(const GridAxis& axis)
      : per_unit(all(axis.pixels_per_unit)), middle(all(0.5 * (axis.count - 1))), count(all(axis.count)) {}

  /// Positions in units of the seventh decimal: of decimals, which `is_decimal` masks, whole.
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

/// Some triangles of any doubles: the numbers that DepthPlane has for one.
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
      // A NaN stays in the sum.
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
  Pairs q_u, q_v, r_u, r_v;  // of the second and the third corner, from the first
  Pairs area;                // twice, with a sign
  Doubles size_u, size_v;    // no number in pixels is larger
  Pairs corner, per_column, per_row;
  Mask are_certain;
};

/// The depth halfway between two columns, which `columns_added_up` are.
HWY_INLINE Doubles middle_depth(const Pairs& corner, const Pairs& per_column, const Pairs& per_row,
                                Doubles columns_added_up, Doubles rows) {
  return ((corner + per_column * (all(0.5) * columns_added_up)) + per_row * rows).hi +
         all(DepthInDoubles::kNoMinus);
}
/// Their slope in half columns.
HWY_INLINE Doubles half_slope_of(const Pairs& per_column) {
  return all(0.5) * per_column.hi + all(DepthInDoubles::kNoMinus);
}

PIPELINE_END_KERNELS();
