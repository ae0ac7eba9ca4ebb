// No include guard: included once for each target, see numbers/vector_targets.h.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <span>

#include "libpipeline/numbers/lanes.h"
#include "libpipeline/picture/true_outline.h"
#include "libpipeline/stream/triangle_batch.h"

PIPELINE_BEGIN_KERNELS();

// The proof. In clip space, without its z, a triangle has the vertices V_i = (x, y, w) of the text and the
// true ones V_i + D_i; w is the distance d in front of the eye, for ortho 1. A point P = (d X, d Y, d) of the
// true triangle is seen at (X, Y). It is sum l_i (V_i + D_i) with l_i >= 0 and sum l_i = 1, so near the point
// P' = sum l_i V_i of the text's. Seen from a pixel's center c, with q = (x - c_x w, y - c_y w), P has q = 0.
// So P' has q' = - sum l_i q(D_i), with |q'| <= a + b w' on each axis, where w' is its own w.
//
// The function e_k, linear in space, is 0 at two of the text's vertices, and their determinant D > 0 at
// vertex k, so that e_k(P') = l_k D. As e_k is N_x q_x + N_y q_y + e_k(c) w, l_k D = e_k(c) w' + N q'. The
// sum over k, with t = sum e_k and G = sum N, is D = t(c) w' + G q'. So 1 / w' is at most m, the greatest
// (t(c) + |G| b) / (D - |G| a) at a center, and l_k >= 0 gives e_k(c) >= - |N| (b + a m).
//
// A center that breaks this for some k is not covered. Where e_k(c) is above the opposite for every k, t is
// above 0, so that w' is, and the line through the eye and c meets no side of the triangle on the way from
// the text's vertices to the true ones, which stays within the bounds. It meets the text's triangle inside,
// so it meets the true one inside.
//
// Where D may be 0, no center is surely covered. e_k(c) is within |N| (b + a m) + D m of 0, as w' is at least
// the smallest w, and at least the nearest distance that is shown less the error of w: m is its reciprocal.
//
// Depths. With weights o_k and o = sum o_k e_k, whose N is N', (sum o_k l_k) D = o(c) w' + N' q'. If f is the
// greatest w and o_k = 1 - w_k / f, the sum is 1 - w' / f, so 1 / w' - 1 / f, which is not below 0, is within
// |N'| (b + a m) / D of o(c) / D. The distance is within the error E of w', so its reciprocal is at most
// (1 / w') / (1 - E m) and at least (1 / w') / (1 + E m). For ortho w' = 1, where a counts as b, and o_k is
// how much nearer a vertex is than the farthest one.
//
// Rounding. X and Y are above |q_x|, |q_y|, a and, times the largest |w|, W, above b and the extent of the
// pixels. No term of e_k exceeds 2 X Y, of D 2 X Y W. Each takes part in at most 40 roundings, three terms in
// 120. So e_k at a pixel, or 31 beyond, is within 2^-45 X Y, t and o (in parts of the greatest o_k) within
// four times that, and D and |N| a within 2^-45 X Y W.

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLost = TrueView::kLost, kUp = TrueView::kUp;

using Mask = hn::Mask<decltype(kDoubles)>;
using ThreeDoubles = std::array<Doubles, 3>;
using LinearLanes = Linear<Doubles>;

HWY_INLINE Doubles lost(Doubles p, Doubles q, Doubles r = all(0)) {
  return all(kLost) * (hn::Abs(p) + hn::Abs(q) + hn::Abs(r));
}
HWY_INLINE Doubles least(const ThreeDoubles& of) {
  return hn::Min(hn::Min(of[0], of[1]), of[2]);
}
HWY_INLINE Doubles greatest(const ThreeDoubles& of) {
  return hn::Max(hn::Max(of[0], of[1]), of[2]);
}
HWY_INLINE Doubles largest(Doubles low, Doubles high) {
  return hn::Max(hn::Abs(low), hn::Abs(high));
}
HWY_INLINE Doubles choose(Mask mask, double there, double elsewhere) {
  return hn::IfThenElse(mask, all(there), all(elsewhere));
}
HWY_INLINE LinearLanes sum(const LinearLanes& f, Doubles factor, const LinearLanes& g) {
  return {f.u + factor * g.u, f.v + factor * g.v, f.constant + factor * g.constant};
}

/// Triangles' vertices in clip space, and how far each may be from the true one.
struct UncertainVertices {
  /// Pieces stand for the triangle that they were cut from. The last index stands in for those beyond it.
  HWY_INLINE UncertainVertices(const TrueView& view, const TriangleBatch& p_ndc,
                               std::span<const std::size_t> indices) {
    const auto largest_rounded = set_vertices(view, p_ndc, indices);
    least_w = least(w);
    greatest_w = greatest(w);
    largest_w = largest(least_w, greatest_w);
    nearest = least(distance);
    farthest = greatest(distance);
    set_errors(view, largest_rounded);
    nearest_shown = hn::Max(least_w, all(view.nearest_shown) - w_error);
  }

  std::array<ThreeDoubles, 2> p;                   // x and y
  ThreeDoubles w, distance;                        // in front of the eye: w, but for ortho, where w is 1
  std::array<Doubles, 2> least_ndc, greatest_ndc;  // x and y
  Doubles least_w, greatest_w, largest_w;          // the last of |w|
  Doubles nearest, farthest;                       // distances
  Doubles nearest_shown;                           // w of what a pixel may show
  Doubles error, w_error, depth_error;             // of each coordinate in view space, w and the distance
  Doubles own, own_per_w;                          // of x and y by the projection's own rounding
  Mask is_whole;                                   // before it was cut

 private:
  /// Returns the largest coordinate of each triangle that was rounded.
  HWY_INLINE Doubles set_vertices(const TrueView& view, const TriangleBatch& p_ndc,
                                  std::span<const std::size_t> indices) {
    std::array<std::array<std::array<double, kLanes>, 4>, 3> read;
    std::array<double, kLanes> are_whole;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t index = indices[std::min(lane, indices.size() - 1)];
      const ClipTriangle* const whole = p_ndc.unclipped_of(index);  // in clip space, with all digits
      are_whole[lane] = whole == nullptr ? 0 : 1;
      for (std::size_t i = 0; i < 3; ++i) {
        const Vec3& at = whole == nullptr ? p_ndc.triangles[index][i] : (*whole)[i].position;
        read[i][0][lane] = at.x;
        read[i][1][lane] = at.y;
        read[i][2][lane] = at.z;
        read[i][3][lane] = whole == nullptr ? p_ndc.attributes.w[index][i] : (*whole)[i].w;
      }
    }
    is_whole = hn::Gt(hn::LoadU(kDoubles, are_whole.data()), all(0));
    std::array<ThreeDoubles, 2> ndc;
    auto largest_rounded = all(0);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto number = [&](std::size_t k) HWY_ATTR { return hn::LoadU(kDoubles, read[i][k].data()); };
      const Vectors at = {number(0), number(1), number(2)};
      w[i] = view.is_perspective ? number(3) : all(1);
      const auto to_clip = hn::IfThenElse(is_whole, all(1), w[i]);
      const auto to_ndc = hn::IfThenElse(is_whole, all(1) / w[i], all(1));
      p[0][i] = at.x * to_clip;
      p[1][i] = at.y * to_clip;
      ndc[0][i] = at.x * to_ndc;
      ndc[1][i] = at.y * to_ndc;
      distance[i] = view.is_perspective
                        ? number(3)
                        : (at.z * all(view.far - view.near) + all(view.far) + all(view.near)) * all(0.5);
      largest_rounded = hn::Max(largest_rounded, largest_in(at));
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      least_ndc[axis] = least(ndc[axis]);
      greatest_ndc[axis] = greatest(ndc[axis]);
    }
    return largest_rounded;
  }

  HWY_INLINE void set_errors(const TrueView& view, Doubles largest_rounded) {
    largest_rounded = hn::Max(largest_rounded, hn::IfThenElseZero(is_whole, largest_w));
    const ErrorBound of_whole = rounding_error(kShortest), of_text = *view.bounds.rounded;
    const auto rounded = (choose(is_whole, of_whole.absolute, of_text.absolute) +
                          choose(is_whole, of_whole.relative, of_text.relative) * largest_rounded) *
                         all(ErrorBound::kRoundUp);
    const auto by_rounding = rounded + lost(largest_rounded, all(0)) * all(0.25);
    own = hn::IfThenElseZero(is_whole, by_rounding);
    own_per_w = hn::IfThenZeroElse(is_whole, by_rounding);
    const double range = view.far - view.near;
    const auto of_depth =
        view.is_perspective
            ? all(0)
            : all(range / 2) * rounded + lost(largest_rounded * all(range), all(view.far), all(view.near));
    // x and y in view space, of clip space's at most so much
    const auto in_clip =
        hn::IfThenElse(is_whole, largest_rounded, largest_rounded * largest_w) + by_rounding * largest_w;
    const auto in_view = [&](const TrueView::Axis& a) HWY_ATTR {
      return (in_clip + own + all(std::fabs(a.center)) * largest_w) * all(a.view_per_clip);
    };
    const auto x = in_view(view.axes[0]), y = in_view(view.axes[1]),
               z = largest(nearest, farthest) + of_depth;
    const ErrorBound of_view = view.bounds.error;
    const auto bound =
        (all(of_view.absolute) + all(of_view.relative) * (hn::Max(hn::Max(x, y), z) * all(kUp))) *
        all(ErrorBound::kRoundUp) * all(kUp);
    error = hn::IfThenElse(hn::Lt(x + y + z, all(kInfinity)), bound, all(kInfinity));
    w_error = view.is_perspective ? error : all(0);
    depth_error = (error + of_depth) * all(kUp);
  }
};

HWY_INLINE Doubles from_center(const TrueView::Axis& a, Doubles low, Doubles high) {
  const auto center = all(a.center);
  return hn::Max(hn::Abs(low - center), hn::Abs(high - center)) + lost(low, high, center);
}

/// Sets the pixels of an axis around the true triangles.
HWY_INLINE void set_cells(const TrueView& view, std::size_t axis, const UncertainVertices& v, Doubles& first,
                          Doubles& end) {
  /// Pixels more than the divisions for them can lose on a screen.
  constexpr double kMargin = 1e-6;
  const TrueView::Axis& a = view.axes[axis];
  const auto low = v.least_ndc[axis], high = v.greatest_ndc[axis];
  const auto turn = view.is_perspective ? from_center(a, low, high) : all(0);
  const auto moved = (((all(a.scale) + turn + v.own_per_w) * v.error + v.own) / (v.least_w - v.w_error) +
                      v.own_per_w + all(a.error) + lost(low, high)) *
                     all(kUp);
  const auto at_low = (low - moved - all(a.first)) * all(a.per_step);
  const auto at_high = (high + moved - all(a.first)) * all(a.per_step);
  const auto in_screen = [](Doubles at, double least)
                             HWY_ATTR { return hn::Min(hn::Max(at, all(least)), all(1e6)); };
  const auto begin = in_screen(a.step < 0 ? at_high : at_low, 0) + all(1 - kMargin);
  const auto last = in_screen(a.step < 0 ? at_low : at_high, -1) + all(1 + kMargin);
  const auto is_bounded = hn::And(hn::Gt(v.least_w, all(2) * v.w_error), hn::Lt(moved, all(kInfinity)));
  const auto of_screen = all(a.cells.first), to_screen = all(a.cells.end);
  first = hn::IfThenElse(is_bounded, hn::Max(of_screen, hn::Floor(begin)), of_screen);
  end = hn::IfThenElse(is_bounded, hn::Min(to_screen, hn::Floor(last)), to_screen);
}

/// Sets the box and the range of depths.
HWY_INLINE void set_box(const TrueView& view, const UncertainVertices& v, TrueOutline<Doubles>& outline) {
  set_cells(view, 0, v, outline.first_column, outline.end_column);
  set_cells(view, 1, v, outline.first_row, outline.end_row);
  if (!view.is_perspective) {
    outline.least = v.nearest - v.depth_error;
    outline.greatest = v.farthest + v.depth_error;
    return;
  }
  outline.end_row = hn::IfThenElse(hn::Lt(v.greatest_w, v.nearest_shown), outline.first_row, outline.end_row);
  const auto nearest = hn::IfThenElseZero(hn::Gt(v.least_w, all(2) * v.error), v.least_w - v.error);
  outline.least = all(-(1 + kLost)) / hn::Max(nearest, all(view.nearest_shown));
  outline.greatest = all(-(1 - kLost)) / (v.greatest_w + v.error);
}

/// Triangles as the centers of their outlines' first pixels see them, in pixels.
struct SeenTriangles {
  HWY_INLINE SeenTriangles(const TrueView& view, const UncertainVertices& v,
                           const TrueOutline<Doubles>& outline) {
    std::array<Doubles, 2> reach;  // X and Y of the proof
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const TrueView::Axis& a = view.axes[axis];
      const auto first = axis == 0 ? outline.first_column : outline.first_row;
      const auto end = axis == 0 ? outline.end_column : outline.end_row;
      const auto center = all(a.first) + first * all(a.step), size = all(std::fabs(a.per_step) * kUp);
      ThreeDoubles from_center_of_pixel;
      for (std::size_t i = 0; i < 3; ++i) {
        from_center_of_pixel[i] = (v.p[axis][i] - center * v.w[i]) * all(a.per_step);
        (axis == 0 ? q[i].x : q[i].y) = from_center_of_pixel[i];
      }
      const auto turn =
          view.is_perspective ? from_center(a, center, all(a.first) + end * all(a.step)) : all(0);
      const auto of_center = hn::IfThenElseZero(v.is_whole, all(a.error) * v.largest_w);
      const auto fixed_shift =
          ((all(a.scale) + turn + all(2 * a.error)) * v.error + v.own + of_center) * size;
      shift[axis] = view.is_perspective ? fixed_shift : all(0);
      shift_per_w[axis] =
          (v.own_per_w + all(2 * a.error)) * size + (view.is_perspective ? all(0) : fixed_shift);
      reach[axis] = largest(least(from_center_of_pixel), greatest(from_center_of_pixel)) + fixed_shift +
                    (end - first + shift_per_w[axis]) * v.largest_w;
    }
    for (std::size_t i = 0; i < 3; ++i) q[i].z = v.w[i];
    edge_error = all(0x1p-45) * reach[0] * reach[1];
    area_error = edge_error * v.largest_w;
  }

  /// |N| a of a function, and |N| b.
  [[nodiscard]] HWY_INLINE Doubles fixed(const LinearLanes& f) const { return moved(f, shift); }
  [[nodiscard]] HWY_INLINE Doubles per_w(const LinearLanes& f) const { return moved(f, shift_per_w); }
  HWY_INLINE static Doubles moved(const LinearLanes& f, const std::array<Doubles, 2>& by) {
    return (hn::Abs(f.u) * by[0] + hn::Abs(f.v) * by[1]) * all(kUp);
  }
  /// Sets e, and D, above 0.
  HWY_INLINE void set_edges() {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vectors &a = q[(k + 1) % 3], &b = q[(k + 2) % 3];
      e[k] = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    }
    const auto determinant = dot(q[0], {e[0].u, e[0].v, e[0].constant});
    const auto sign = choose(hn::Lt(determinant, all(0)), -1, 1);
    for (LinearLanes& edge : e) edge = {edge.u * sign, edge.v * sign, edge.constant * sign};
    area = hn::Abs(determinant);
  }
  /// The side where `e_k` is 0, which may be off by the margin; anywhere if not regular.
  HWY_INLINE Side<Doubles> side(const LinearLanes& e_k, Doubles margin, Mask is_regular,
                                Mask may_be_sure) const {
    // Where u is next to nothing, so is its part in the value, and a row is wholly on one side: over 2^16
    // columns another u of that size moves the value by at most an eighth of what roundings may.
    const auto least_u = all(0x1p-20) * edge_error;
    const auto per_value = all(-1) / hn::IfThenElse(hn::Gt(hn::Abs(e_k.u), least_u), e_k.u, least_u);
    const auto far = all(kInfinity), before = all(-kInfinity);
    const auto by = hn::IfThenElse(is_regular, margin * hn::Abs(per_value) * all(kUp), far);
    const auto is_left = hn::Lt(per_value, all(0)), is_unsure = hn::Not(may_be_sure);
    return {hn::IfThenElseZero(is_regular, e_k.v),
            hn::IfThenElseZero(is_regular, e_k.constant),
            hn::IfThenElseZero(is_regular, per_value),
            {hn::IfThenElse(hn::Or(is_left, is_unsure), hn::Neg(by), before),
             hn::IfThenElse(is_unsure, far, hn::IfThenElse(is_left, by, before))},
            {hn::IfThenElse(hn::And(is_left, may_be_sure), far, by),
             hn::IfThenElse(is_unsure, before, hn::IfThenElse(is_left, far, hn::Neg(by)))}};
  }

  std::array<Vectors, 3> q;                   // z is w
  std::array<Doubles, 2> shift, shift_per_w;  // a and b of the proof
  Doubles edge_error, area_error;             // by rounding
  std::array<LinearLanes, 3> e;
  Doubles area;  // D
};

/// Sets the depths where `has_depths`, if 1 / w' is at most `most_per_w`; elsewhere they are the range's.
HWY_INLINE void set_depths(const TrueView& view, const UncertainVertices& v, const SeenTriangles& seen,
                           Doubles most_per_w, Mask has_depths, TrueOutline<Doubles>& outline) {
  const auto weight = view.is_perspective ? all(1) / v.greatest_w : all(1);
  LinearLanes o = {all(0), all(0), all(0)};
  for (std::size_t k = 0; k < 3; ++k) o = sum(o, (v.farthest - v.distance[k]) * weight, seen.e[k]);
  const auto rounding = all(4) * (v.farthest - v.nearest) * weight * seen.edge_error;
  const auto margin = seen.per_w(o) + seen.fixed(o) * most_per_w + rounding;
  const auto moved = v.w_error * most_per_w;
  const auto nearer = all(1) / (all(1) - moved), farther = all(1) / (all(1) + moved);
  const auto per_nearest = nearer / (seen.area - seen.area_error);
  const auto per_farthest = farther / (seen.area + seen.area_error);
  const auto nearest =
      view.is_perspective ? hn::Neg(nearer) * weight * all(1 + kLost) : v.farthest - v.depth_error;
  const auto farthest =
      view.is_perspective ? hn::Neg(farther) * weight * all(1 - kLost) : v.farthest + v.depth_error;
  const auto set = [&](LinearLanes& depths, Doubles per, Doubles constant, Doubles limit) HWY_ATTR {
    depths = {hn::IfThenElseZero(has_depths, hn::Neg(per) * o.u),
              hn::IfThenElseZero(has_depths, hn::Neg(per) * o.v),
              hn::IfThenElse(has_depths, constant, limit)};
  };
  set(outline.nearest, per_nearest, nearest - per_nearest * (o.constant + margin), outline.least);
  set(outline.farthest, per_farthest, farthest - per_farthest * (o.constant - margin), outline.greatest);
}

/// Sets the sides and depths of outlines with a box, which may turn out to be empty.
HWY_INLINE void set_sides(const TrueView& view, const UncertainVertices& v, TrueOutline<Doubles>& outline) {
  SeenTriangles seen(view, v, outline);
  // Else numbers overflow, or are so small that they lose digits.
  const auto is_regular =
      hn::And(hn::Gt(v.nearest_shown, all(2) * v.w_error),
              hn::And(hn::Gt(seen.area_error, all(1e-250)), hn::Lt(seen.area_error, all(1e250))));
  seen.set_edges();
  const LinearLanes t = sum(sum(seen.e[0], all(1), seen.e[1]), all(1), seen.e[2]);
  const auto least_area = seen.area - seen.area_error - seen.fixed(t);
  const auto may_be_sure = hn::And(is_regular, hn::Gt(least_area, seen.area * all(0.25)));
  const auto most_t = t.constant + hn::Max(t.u * (outline.end_column - outline.first_column), all(0)) +
                      hn::Max(t.v * (outline.end_row - outline.first_row), all(0));
  const auto by_area = (most_t + seen.per_w(t) + all(4) * seen.edge_error) / least_area * all(kUp);
  const auto by_w = hn::IfThenElse(hn::Gt(v.least_w, all(0)), all(1) / v.least_w * all(kUp), all(kInfinity));
  // m of the proof
  const auto most_per_w =
      hn::IfThenElse(may_be_sure, hn::Min(by_area, by_w), all(1) / v.nearest_shown * all(kUp));
  const auto is_behind_eye = hn::AndNot(hn::Gt(most_per_w, all(0)), may_be_sure);
  const auto has_depths = hn::And(may_be_sure, hn::Lt(v.w_error * most_per_w, all(0.5)));
  set_depths(view, v, seen, most_per_w, has_depths, outline);
  const auto of_area = seen.area_error + hn::IfThenZeroElse(may_be_sure, seen.area + seen.area_error);
  for (std::size_t k = 0; k < 3; ++k) {
    const LinearLanes& e = seen.e[k];
    const auto margin = (seen.fixed(e) + of_area) * most_per_w + seen.per_w(e) + seen.edge_error;
    outline.sides[k] = seen.side(e, margin, is_regular, may_be_sure);
  }
  outline.end_row = hn::IfThenElse(is_behind_eye, outline.first_row, outline.end_row);
}

/// The outline in a lane.
HWY_INLINE TrueOutline<double> in_lane(const TrueOutline<Doubles>& outlines, std::size_t lane) {
  std::array<double, sizeof(TrueOutline<double>) / sizeof(double)> outline;
  std::array<double, outline.size() * kLanes> numbers;
  static_assert(sizeof numbers == sizeof outlines);
  std::memcpy(numbers.data(), &outlines, sizeof numbers);
  for (std::size_t i = 0; i < outline.size(); ++i) outline[i] = numbers[i * kLanes + lane];
  return std::bit_cast<TrueOutline<double>>(outline);
}

PIPELINE_END_KERNELS();
