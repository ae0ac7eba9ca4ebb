#include "libpipeline/picture/true_outline.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {

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

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// More than sums of a few doubles lose, as a part of the sum of their absolute values.
constexpr double kLost = 0x1p-49;
constexpr double kUp = 1 + 0x1p-40;
/// Pixels more than the divisions for them can lose on a screen.
constexpr double kMargin = 1e-6;

double lost(double p, double q, double r = 0) {
  return kLost * (std::fabs(p) + std::fabs(q) + std::fabs(r));
}

double least(const std::array<double, 3>& of) {
  return std::min(std::min(of[0], of[1]), of[2]);
}

double greatest(const std::array<double, 3>& of) {
  return std::max(std::max(of[0], of[1]), of[2]);
}

double largest(double low, double high) {
  return std::max(std::fabs(low), std::fabs(high));
}

Linear sum(const Linear& f, double factor, const Linear& g) {
  return {f.u + factor * g.u, f.v + factor * g.v, f.constant + factor * g.constant};
}

}  // namespace

double TrueOutlines::Axis::from_center(double low, double high) const {
  return std::max(std::fabs(low - center), std::fabs(high - center)) + lost(low, high, center);
}

TrueOutlines::TrueOutlines(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : bounds_(bounds), is_perspective_(std::holds_alternative<Frustum>(projected)) {
  const auto axis = [&](double low, double high, double first, double step, double limit,
                        const RowRange& all) {
    const double scale = std::fabs((is_perspective_ ? 2 * near_ : 2) / (high - low));
    return Axis{first, step, 1 / step, lost(limit, 0), scale, 1 / scale * kUp, -(high + low) / (high - low),
                all};
  };
  const auto set = [&](const auto& p) {
    near_ = p.near;
    far_ = p.far;
    axes_ = {axis(p.left, p.right, screen.left_x(), screen.dx(), screen.left, {0, screen.columns}),
             axis(p.bottom, p.top, screen.top_y(), -screen.dy(), screen.bottom, screen.drawn_rows())};
  };
  if (is_perspective_)
    set(std::get<Frustum>(projected));
  else
    set(std::get<Orthographic>(projected));
  if (!is_perspective_) return;
  const double front = depths_at(screen.front)[0];
  // Triangles that come no nearer than near / 1024 are not cut.
  nearest_shown_ = std::max(near_ / 1024, front < 0 ? -1 / front : kInfinity) / kUp;
}

std::array<double, 2> TrueOutlines::depths_at(double z) const {
  const double range = far_ - near_, sign = is_perspective_ ? -1 : 1;
  const double middle = z * range + sign * (far_ + near_), error = lost(z * range, far_, near_);
  const auto scaled = [&](double depth) { return is_perspective_ ? depth / near_ / far_ / 2 : depth / 2; };
  if (!std::isfinite(error)) return {-kInfinity, kInfinity};
  return {scaled(middle - error), scaled(middle + error)};
}

void TrueOutlines::set_vertices(UncertainVertices& v, const TriangleBatch& p_ndc, std::size_t index) const {
  const ClipTriangle* const whole = p_ndc.unclipped_of(index);  // in clip space, with all digits
  v.is_whole = whole != nullptr;
  std::array<std::array<double, 3>, 2> ndc;
  double largest_rounded = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = v.is_whole ? (*whole)[i].position : p_ndc.triangles[index][i];
    const double w = v.is_whole ? (*whole)[i].w : p_ndc.attributes.w[index][i];
    v.w[i] = is_perspective_ ? w : 1;
    const double to_clip = v.is_whole ? 1 : v.w[i], to_ndc = v.is_whole ? 1 / v.w[i] : 1;
    v.p[0][i] = p.x * to_clip;
    v.p[1][i] = p.y * to_clip;
    ndc[0][i] = p.x * to_ndc;
    ndc[1][i] = p.y * to_ndc;
    v.distance[i] = is_perspective_ ? w : (p.z * (far_ - near_) + far_ + near_) / 2;
    largest_rounded = std::max(largest_rounded, largest_in(p));
  }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    v.least_ndc[axis] = least(ndc[axis]);
    v.greatest_ndc[axis] = greatest(ndc[axis]);
  }
  v.least_w = least(v.w);
  v.greatest_w = greatest(v.w);
  v.largest_w = largest(v.least_w, v.greatest_w);
  v.nearest = least(v.distance);
  v.farthest = greatest(v.distance);
  set_errors(v, largest_rounded);
}

void TrueOutlines::set_errors(UncertainVertices& v, double largest_rounded) const {
  if (v.is_whole) largest_rounded = std::max(largest_rounded, v.largest_w);
  const double rounded = (v.is_whole ? rounding_error(kShortest) : *bounds_.rounded).at(largest_rounded);
  const double own = rounded + lost(largest_rounded, 0) / 4;
  v.own = v.is_whole ? own : 0;
  v.own_per_w = v.is_whole ? 0 : own;
  const double range = far_ - near_;
  const double of_depth =
      is_perspective_ ? 0 : range / 2 * rounded + lost(largest_rounded * range, far_, near_);
  // x and y in view space, of clip space's at most so much
  const double in_clip = (v.is_whole ? largest_rounded : largest_rounded * v.largest_w) + own * v.largest_w;
  const auto in_view = [&](const Axis& a) {
    return (in_clip + v.own + std::fabs(a.center) * v.largest_w) * a.view_per_clip;
  };
  const double x = in_view(axes_[0]), y = in_view(axes_[1]), z = largest(v.nearest, v.farthest) + of_depth;
  v.error = std::isfinite(x + y + z) ? bounds_.error.at(std::max(std::max(x, y), z) * kUp) * kUp : kInfinity;
  v.w_error = is_perspective_ ? v.error : 0;
  v.depth_error = (v.error + of_depth) * kUp;
}

/// The pixels of an axis around the true triangle.
RowRange TrueOutlines::cells_of(std::size_t axis, const UncertainVertices& v) const {
  const Axis& a = axes_[axis];
  const double low = v.least_ndc[axis], high = v.greatest_ndc[axis];
  const double turn = is_perspective_ ? a.from_center(low, high) : 0;
  const double moved = (((a.scale + turn + v.own_per_w) * v.error + v.own) / (v.least_w - v.w_error) +
                        v.own_per_w + a.error + lost(low, high)) *
                       kUp;
  if (!(v.least_w > 2 * v.w_error && moved < kInfinity)) return a.cells;
  double first = (low - moved - a.first) * a.per_step, last = (high + moved - a.first) * a.per_step;
  if (a.step < 0) std::swap(first, last);
  // Conversions to int round down.
  return {std::max(a.cells.first, static_cast<int>(std::clamp(first, 0.0, 1e6) + (1 - kMargin))),
          std::min(a.cells.end, static_cast<int>(std::clamp(last, -1.0, 1e6) + (1 + kMargin)))};
}

void TrueOutlines::set_box(TrueOutline& outline, const TriangleBatch& p_ndc, std::size_t index) const {
  UncertainVertices& v = outline.vertices;
  set_vertices(v, p_ndc, index);
  outline.columns = cells_of(0, v);
  outline.rows = cells_of(1, v);
  v.nearest_shown = std::max(v.least_w, nearest_shown_ - v.w_error);
  if (!is_perspective_) {
    outline.least = v.nearest - v.depth_error;
    outline.greatest = v.farthest + v.depth_error;
    return;
  }
  if (v.greatest_w < v.nearest_shown) outline.rows = {0, 0};
  outline.least = -(1 + kLost) / std::max(v.least_w > 2 * v.error ? v.least_w - v.error : 0, nearest_shown_);
  outline.greatest = -(1 - kLost) / (v.greatest_w + v.error);
}

/// A triangle as the center of the outline's first pixel sees it, in pixels.
struct TrueOutlines::Seen {
  std::array<Vec3, 3> q;                     // z is w
  std::array<double, 2> shift, shift_per_w;  // a and b of the proof
  double edge_error, area_error;             // by rounding
  std::array<Linear, 3> e;
  double area;  // D

  /// |N| a of a function, and |N| b.
  [[nodiscard]] double fixed(const Linear& f) const { return moved(f, shift); }
  [[nodiscard]] double per_w(const Linear& f) const { return moved(f, shift_per_w); }
  static double moved(const Linear& f, const std::array<double, 2>& by) {
    return (std::fabs(f.u) * by[0] + std::fabs(f.v) * by[1]) * kUp;
  }
  void set_edges();
  [[nodiscard]] Side side(const Linear& e_k, double margin, bool may_be_sure) const;
};

TrueOutlines::Seen TrueOutlines::seen_from_first(const TrueOutline& outline) const {
  const UncertainVertices& v = outline.vertices;
  Seen seen;
  std::array<double, 2> reach;  // X and Y of the proof
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Axis& a = axes_[axis];
    const RowRange& cells = axis == 0 ? outline.columns : outline.rows;
    const double center = a.at(cells.first), size = std::fabs(a.per_step) * kUp;
    std::array<double, 3> q;
    for (std::size_t i = 0; i < 3; ++i) q[i] = (v.p[axis][i] - center * v.w[i]) * a.per_step;
    for (std::size_t i = 0; i < 3; ++i) (axis == 0 ? seen.q[i].x : seen.q[i].y) = q[i];
    const double turn = is_perspective_ ? a.from_center(center, a.at(cells.end)) : 0;
    const double of_center = v.is_whole ? a.error * v.largest_w : 0;
    const double fixed = ((a.scale + turn + 2 * a.error) * v.error + v.own + of_center) * size;
    seen.shift[axis] = is_perspective_ ? fixed : 0;
    seen.shift_per_w[axis] = (v.own_per_w + 2 * a.error) * size + (is_perspective_ ? 0 : fixed);
    reach[axis] = largest(least(q), greatest(q)) + fixed +
                  (cells.end - cells.first + seen.shift_per_w[axis]) * v.largest_w;
  }
  for (std::size_t i = 0; i < 3; ++i) seen.q[i].z = v.w[i];
  seen.edge_error = 0x1p-45 * reach[0] * reach[1];
  seen.area_error = seen.edge_error * v.largest_w;
  return seen;
}

/// Sets e, and D, above 0.
void TrueOutlines::Seen::set_edges() {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 normal = cross(q[(k + 1) % 3], q[(k + 2) % 3]);
    e[k] = {normal.x, normal.y, normal.z};
  }
  area = dot(q[0], {e[0].u, e[0].v, e[0].constant});
  if (area < 0)
    for (Linear& edge : e) edge = {-edge.u, -edge.v, -edge.constant};
  area = std::fabs(area);
}

/// The side where `e_k` is 0, which may be off by the margin.
Side TrueOutlines::Seen::side(const Linear& e_k, double margin, bool may_be_sure) const {
  // Where u is next to nothing, so is its part in the value, and a row is wholly on one side: over 2^16
  // columns another u of that size moves the value by at most an eighth of what roundings may.
  const double least_u = 0x1p-20 * edge_error;
  Side side = {e_k.v, e_k.constant, -1 / (std::fabs(e_k.u) > least_u ? e_k.u : least_u)};
  const double by = margin * std::fabs(side.columns_per_value) * kUp;
  if (!may_be_sure) {
    side.low[0] = -by;
    side.high[0] = by;
  } else if (side.columns_per_value < 0) {  // a left one
    side.low = {-by, by};
    side.high[1] = kInfinity;
  } else {
    side.low[1] = -kInfinity;
    side.high = {by, -by};
  }
  return side;
}

void TrueOutlines::set_sides(TrueOutline& outline) const {
  const UncertainVertices& v = outline.vertices;
  Seen seen = seen_from_first(outline);
  outline.sides = {};
  outline.nearest = {0, 0, outline.least};
  outline.farthest = {0, 0, outline.greatest};
  // Else numbers overflow, or are so small that they lose digits.
  if (!(v.nearest_shown > 2 * v.w_error && seen.area_error > 1e-250 && seen.area_error < 1e250)) return;
  seen.set_edges();
  const Linear t = sum(sum(seen.e[0], 1, seen.e[1]), 1, seen.e[2]);
  const double least_area = seen.area - seen.area_error - seen.fixed(t);
  const bool may_be_sure = least_area > seen.area / 4;
  double most_per_w = 1 / v.nearest_shown * kUp;  // m of the proof
  if (may_be_sure) {
    const double most_t = t.constant + std::max(t.u * (outline.columns.end - outline.columns.first), 0.0) +
                          std::max(t.v * (outline.rows.end - outline.rows.first), 0.0);
    most_per_w = (most_t + seen.per_w(t) + 4 * seen.edge_error) / least_area * kUp;
    if (v.least_w > 0) most_per_w = std::min(most_per_w, 1 / v.least_w * kUp);
    if (!(most_per_w > 0)) outline.rows = {0, 0};  // behind the eye
    if (v.w_error * most_per_w < 0.5) set_depths(outline, seen, most_per_w);
  }
  const double of_area = seen.area_error + (may_be_sure ? 0 : seen.area + seen.area_error);
  for (std::size_t k = 0; k < 3; ++k) {
    const Linear& e = seen.e[k];
    const double margin = (seen.fixed(e) + of_area) * most_per_w + seen.per_w(e) + seen.edge_error;
    outline.sides[k] = seen.side(e, margin, may_be_sure);
  }
}

/// The depths, where 1 / w' is at most `most_per_w`.
void TrueOutlines::set_depths(TrueOutline& outline, const Seen& seen, double most_per_w) const {
  const UncertainVertices& v = outline.vertices;
  const double weight = is_perspective_ ? 1 / v.greatest_w : 1;
  Linear o;
  for (std::size_t k = 0; k < 3; ++k) o = sum(o, (v.farthest - v.distance[k]) * weight, seen.e[k]);
  const double rounding = 4 * (v.farthest - v.nearest) * weight * seen.edge_error;
  const double margin = seen.per_w(o) + seen.fixed(o) * most_per_w + rounding;
  const double moved = v.w_error * most_per_w, nearer = 1 / (1 - moved), farther = 1 / (1 + moved);
  const double per_nearest = nearer / (seen.area - seen.area_error);
  const double per_farthest = farther / (seen.area + seen.area_error);
  const double nearest = is_perspective_ ? -nearer * weight * (1 + kLost) : v.farthest - v.depth_error;
  const double farthest = is_perspective_ ? -farther * weight * (1 - kLost) : v.farthest + v.depth_error;
  outline.nearest = {-per_nearest * o.u, -per_nearest * o.v, nearest - per_nearest * (o.constant + margin)};
  outline.farthest = {-per_farthest * o.u, -per_farthest * o.v,
                      farthest - per_farthest * (o.constant - margin)};
}

}  // namespace pipeline
