#include "libpipeline/picture/true_outline.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {

// The proof. In clip space, without its z, a triangle has the vertices V_i = (x, y, w) of the text and the
// true ones V_i + D_i; w is the distance d in front of the eye, for ortho 1. A point P = (d X, d Y, d) of the
// true triangle is seen at (X, Y). It is sum l_i (V_i + D_i) with l_i >= 0 and sum l_i = 1, so near the point
// P' = sum l_i V_i of the text's. Seen from a pixel's center c, with q = (x - c_x w, y - c_y w), P has q = 0.
// So P' has q' = - sum l_i q(D_i), with |q'_x| <= a_x + b_x w', where w' is its own w (FixedAndPerW).
//
// The function e_k, linear in space, is 0 at two of the text's vertices, and their determinant D > 0 at
// vertex k, so that e_k(P') = l_k D. As e_k is N_x q_x + N_y q_y + e_k(c) w, l_k D = e_k(c) w' + N q'. The
// sum over k, with t = sum e_k and G = sum N, is D = t(c) w' + G q'. So |t(c) w' - D| <= |G| a + |G| b w',
// which bounds w', and l_k >= 0 gives e_k(c) >= - |N| b - |N| a / w'.
//
// A center that breaks this for some k is not covered. Where e_k(c) is above the opposite for every k, t is
// above 0, so that w' is, and the line through the eye and c meets no side of the triangle on the way from
// the text's vertices to the true ones, which stays within the bounds. It meets the text's triangle inside,
// so it meets the true one inside.
//
// Where D may be 0, e_k(c) w' is within |N| a + |N| b w' of l_k D, and w' is at least the smallest w, and at
// least the nearest distance that is shown less the error of w.
//
// The sum of e_k(P') times the distance of vertex k is D times that of P': the latter is w' in perspective,
// where the sum is D everywhere, and else the sum at c over t(c), but for N q'.

/// A vertex in clip space.
struct TrueOutlines::Vertex {
  std::array<double, 2> p;  // x and y
  double w;
  double distance;         // in front of the eye: w, but for ortho
  double error;            // of each coordinate in view space
  double own_error;        // of x and y by the projection's own rounding
  double own_depth_error;  // and of the distance
};

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// More than sums of a few doubles lose, as a part of the sum of their absolute values.
constexpr double kLost = 0x1p-49;
constexpr double kUp = 1 + 0x1p-40, kDown = 1 - 0x1p-40;

double lost(double p, double q, double r = 0) {
  return kLost * (std::fabs(p) + std::fabs(q) + std::fabs(r));
}

Linear sum(const Linear& f, double factor, const Linear& g) {
  const double size = std::fabs(factor);
  return {f.u + factor * g.u,           f.v + factor * g.v,           f.constant + factor * g.constant,
          f.u_error + size * g.u_error, f.v_error + size * g.v_error, (f.error + size * g.error) * kUp};
}

Linear raised(Linear f, double by) {
  f.constant += by;
  return f;
}

/// The bound on means of the vertices' `errors`, of which `common` is in all.
FixedAndPerW bound_of(const std::array<double, 3>& errors, const std::array<double, 3>& w, double common) {
  const double least = std::min({w[0], w[1], w[2]});
  if (!(least > 0)) return {std::max({errors[0], errors[1], errors[2]}) * kUp, 0};
  double per_w = 0;
  for (std::size_t i = 0; i < 3; ++i) per_w = std::max(per_w, (errors[i] - common) / w[i]);
  // What the subtraction and the division lose is less than 2^-50 of the whole error.
  return {common * kUp, (per_w + kLost * common / least) * kUp};
}

}  // namespace

std::pair<double, double> TrueOutline::widened(double least, double greatest) const {
  const auto margin = [&](double distance) {
    return (widening.fixed + (widening.per_w + kLost) * std::fabs(distance)) * kUp;
  };
  // The difference grows with the distance only where less than all of it is subtracted.
  const double nearest_true = least - margin(least), farthest_true = greatest + margin(greatest);
  return {widening.per_w < 0.5 && !std::isnan(nearest_true) ? nearest_true : -kInfinity,
          std::isnan(farthest_true) ? kInfinity : farthest_true};
}

std::pair<double, double> TrueOutline::distances(double at_u, double at_v) const {
  double least_there = low, greatest_there = high;
  if (may_be_sure) {
    const double most_below = bottom.at(at_u, at_v) + bottom.error,
                 least_below = most_below - 2 * bottom.error;
    if (most_below <= 0) return {kInfinity, -kInfinity};  // behind the eye
    const double least = top.at(at_u, at_v) - top.error, most = least + 2 * top.error;
    if (least_below > 0) {
      least_there = std::max(low, least / (least > 0 ? most_below : least_below));
      greatest_there = std::min(high, most / (most > 0 ? least_below : most_below));
    } else if (least > 0) {
      least_there = std::max(low, least / most_below);
    }
  }
  return widened(least_there, greatest_there);
}

/// A triangle in clip space as a pixel's center sees it, q and w, and how far a point of the true triangle
/// may be from one of the text's.
struct TrueOutlines::Seen {
  std::array<Vec3, 3> q;  // z is w
  double w_error = 0;     // the largest of a vertex
  FixedAndPerW w_shift;
  std::array<FixedAndPerW, 2> shift;
  std::array<double, 2> reach;  // from the center to any pixel of the outline

  /// How much a function may differ between the two: a part, and that for each unit of w.
  [[nodiscard]] double fixed(const Linear& f) const { return moved(f, shift[0].fixed, shift[1].fixed); }
  [[nodiscard]] double per_w(const Linear& f) const { return moved(f, shift[0].per_w, shift[1].per_w); }
  static double moved(const Linear& f, double by_x, double by_y) {
    return ((std::fabs(f.u) + f.u_error) * by_x + (std::fabs(f.v) + f.v_error) * by_y) * kUp;
  }
};

double TrueOutlines::Axis::from_center(double at) const {
  return std::fabs(at - center) + lost(at, center);
}

TrueOutlines::TrueOutlines(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : screen_(screen), bounds_(bounds), is_perspective_(std::holds_alternative<Frustum>(projected)) {
  const auto axis = [&](double low, double high, double first, double step, double limit) {
    return Axis{first, step, lost(limit, 0), (is_perspective_ ? 2 * near_ : 2) / (high - low),
                -(high + low) / (high - low)};
  };
  const auto set = [&](const auto& p) {
    near_ = p.near;
    far_ = p.far;
    axes_ = {axis(p.left, p.right, screen.left_x(), screen.dx(), screen.left),
             axis(p.bottom, p.top, screen.top_y(), -screen.dy(), screen.bottom)};
  };
  if (is_perspective_)
    set(std::get<Frustum>(projected));
  else
    set(std::get<Orthographic>(projected));
  // Triangles that come no nearer than near / 1024 are not cut.
  if (is_perspective_) nearest_shown_ = std::max(near_ / 1024, distance_at(screen.front).first) * kDown;
}

std::pair<double, double> TrueOutlines::distance_at(double depth) const {
  const double range = far_ - near_, middle = far_ + near_;
  const double error = lost(depth * range, far_, near_);
  if (!std::isfinite(error)) return {-kInfinity, kInfinity};
  if (!is_perspective_) return {(depth * range + middle) / 2 - error, (depth * range + middle) / 2 + error};
  const double divisor = middle - depth * range;
  const auto limit = [&](double by, double rounding) {
    return by > 0 ? 2 * near_ * (far_ / by) * rounding : kInfinity;
  };
  return {limit(divisor + error, kDown), limit(divisor - error, kUp)};
}

std::array<TrueOutlines::Vertex, 3> TrueOutlines::vertices_of(const TriangleBatch& p_ndc,
                                                              std::size_t index) const {
  const ClipTriangle* const whole = p_ndc.unclipped_of(index);  // in clip space, with all digits
  std::array<Vertex, 3> vertices;
  for (std::size_t i = 0; i < 3; ++i) {
    Vertex& v = vertices[i];
    const Vec3 p = whole != nullptr ? (*whole)[i].position : p_ndc.triangles[index][i];
    v.w = whole != nullptr ? (*whole)[i].w : p_ndc.attributes.w[index][i];
    const double factor = whole != nullptr ? 1 : v.w;
    const double rounded = whole != nullptr
                               ? rounding_error(kShortest).at(std::fmax(largest_in(p), std::fabs(v.w)))
                               : bounds_.rounded->at(largest_in(p)) * factor;
    v.p = {p.x * factor, p.y * factor};
    v.own_error = rounded + lost(v.p[0], v.p[1]) / 4;
    const double range = far_ - near_;
    v.distance = is_perspective_ ? v.w : (p.z * range + far_ + near_) / 2;
    v.own_depth_error = is_perspective_ ? 0 : range / 2 * rounded + lost(p.z * range, far_, near_);
    double largest = std::fabs(v.distance) + v.own_depth_error;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const Axis& a = axes_[axis];
      const double shift = a.center * v.w;
      const double in_view =
          (std::fabs(v.p[axis] - shift) + lost(v.p[axis], shift) + v.own_error) / std::fabs(a.scale);
      largest = std::max(largest, std::isnan(in_view) ? kInfinity : in_view);
    }
    v.error = std::isfinite(largest) ? bounds_.error.at(largest * kUp) * kUp : kInfinity;
  }
  return vertices;
}

/// Sets the pixels around the true triangle.
void TrueOutlines::set_cells(TrueOutline& outline, const std::array<Vertex, 3>& vertices) const {
  outline.columns = {0, screen_.columns};
  outline.rows = screen_.drawn_rows();
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Axis& a = axes_[axis];
    double low = kInfinity, high = -kInfinity;
    bool is_known = true;
    for (const Vertex& v : vertices) {
      const double w_error = is_perspective_ ? v.error : 0, at = v.p[axis] / v.w;
      const double in_clip_space =
          (std::fabs(a.scale) + (is_perspective_ ? a.from_center(at) : 0)) * v.error + v.own_error;
      const double error = in_clip_space / (v.w - w_error) * kUp + a.error + lost(at, 0);
      is_known = is_known && v.w > 2 * w_error && std::isfinite(error);
      low = std::min(low, at - error);
      high = std::max(high, at + error);
    }
    if (!is_known) continue;
    if (a.step < 0) std::swap(low, high);
    constexpr double kMargin = 1e-6;  // beyond what the divisions can lose on a screen
    const auto cell = [](double at) { return static_cast<int>(std::clamp(at, -1.0, 1e6)); };
    RowRange& cells = axis == 0 ? outline.columns : outline.rows;
    cells.first = std::max(cells.first, cell(std::ceil((low - a.first) / a.step - kMargin)));
    cells.end =
        std::max(cells.first, std::min(cells.end, cell(std::floor((high - a.first) / a.step + kMargin)) + 1));
  }
  outline.column = (outline.columns.first + outline.columns.end) / 2;
  outline.row = (outline.rows.first + outline.rows.end) / 2;
}

TrueOutlines::Seen TrueOutlines::seen_from_middle(const std::array<Vertex, 3>& vertices,
                                                  const TrueOutline& outline) const {
  Seen seen;
  std::array<double, 3> errors = {}, w = {};
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = seen.q[i].z = vertices[i].w;
    errors[i] = is_perspective_ ? vertices[i].error : vertices[i].error + vertices[i].own_depth_error;
    seen.w_error = std::max(seen.w_error, is_perspective_ ? errors[i] : 0);
  }
  // A distance is w in perspective alone.
  seen.w_shift = is_perspective_ ? bound_of(errors, w, bounds_.error.absolute)
                                 : FixedAndPerW{std::max({errors[0], errors[1], errors[2]}) * kUp, 0};
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Axis& a = axes_[axis];
    const RowRange& cells = axis == 0 ? outline.columns : outline.rows;
    const double center = a.first + (axis == 0 ? outline.column : outline.row) * a.step;
    seen.reach[axis] = (cells.end - cells.first) / 2 * std::fabs(a.step);  // from the middle, rounded up
    const double turn = is_perspective_ ? a.from_center(center) + seen.reach[axis] : 0;
    const double scale = (std::fabs(a.scale) + turn) * kUp;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vertex& v = vertices[i];
      (axis == 0 ? seen.q[i].x : seen.q[i].y) = v.p[axis] - center * v.w;
      errors[i] = scale * v.error + v.own_error + a.error * (std::fabs(v.w) + v.error) +
                  lost(v.p[axis], center * v.w) / 4;
    }
    seen.shift[axis] = bound_of(errors, w, scale * bounds_.error.absolute);
  }
  return seen;
}

/// The edge functions of the proof, with D above 0.
struct TrueOutlines::Edges {
  explicit Edges(const Seen& seen) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &p = seen.q[(k + 1) % 3], &r = seen.q[(k + 2) % 3];
      e[k] = {p.y * r.z - p.z * r.y, p.z * r.x - p.x * r.z, p.x * r.y - p.y * r.x};
      e[k].u_error = lost(p.y * r.z, p.z * r.y);
      e[k].v_error = lost(p.z * r.x, p.x * r.z);
      e[k].error = e[k].u_error * seen.reach[0] + e[k].v_error * seen.reach[1] + lost(p.x * r.y, p.y * r.x);
    }
    const Vec3& p = seen.q[0];
    area = p.x * e[0].u + p.y * e[0].v + p.z * e[0].constant;
    area_error = (lost(p.x * e[0].u, p.y * e[0].v, p.z * e[0].constant) + std::fabs(p.x) * e[0].u_error +
                  std::fabs(p.y) * e[0].v_error + std::fabs(p.z) * e[0].error) *
                 kUp;
    if (area < 0)
      for (Linear& edge : e) edge = sum({}, -1, edge);
    area = std::fabs(area);
    t = sum(sum(e[0], 1, e[1]), 1, e[2]);
  }

  std::array<Linear, 3> e;
  Linear t;
  double area, area_error;  // D
};

TrueOutline TrueOutlines::of(const TriangleBatch& p_ndc, std::size_t index) const {
  const std::array<Vertex, 3> vertices = vertices_of(p_ndc, index);
  TrueOutline outline;
  set_cells(outline, vertices);
  if (outline.columns.first == outline.columns.end || outline.rows.first == outline.rows.end) return outline;
  const Seen seen = seen_from_middle(vertices, outline);
  const Edges edges(seen);
  const auto& [a, b, c] = vertices;
  const double least_w = std::max(std::min({a.w, b.w, c.w}), nearest_shown_ - seen.w_error);
  const double of_t = seen.fixed(edges.t), least_area = (edges.area - edges.area_error - of_t) * kDown;
  outline.may_be_sure = least_area > edges.area / 4 && least_w > 0;
  outline.possible_count = outline.may_be_sure ? 3 : least_w > 0 ? 6 : 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Linear& e = edges.e[k];
    const double fixed = seen.fixed(e), per_w = seen.per_w(e) + 4 * e.error;
    if (outline.may_be_sure) {  // 1 / w' <= (t + per_w(t)) / (D - fixed(t))
      const double slope = fixed / least_area * kUp;
      const double margin = (per_w + slope * (seen.per_w(edges.t) + 4 * edges.t.error)) * kUp;
      outline.possible[k] = raised(sum(e, slope, edges.t), margin);
      outline.sure[k] = raised(sum(e, -slope, edges.t), -margin);
    } else {
      const double margin = ((edges.area + edges.area_error + fixed) / least_w + per_w) * kUp;
      outline.possible[2 * k] = raised(e, margin);
      outline.possible[2 * k + 1] = raised(sum({}, -1, e), margin);
    }
    if (!is_perspective_) outline.top = sum(outline.top, vertices[k].distance, e);
  }
  const double moved = seen.fixed(outline.top) + seen.per_w(outline.top);
  outline.top.error = (4 * outline.top.error + moved) * kUp;
  if (is_perspective_) outline.top = {0, 0, edges.area, 0, 0, (edges.area_error + of_t) * kUp};
  outline.bottom = edges.t;
  outline.bottom.error = (seen.per_w(edges.t) + 4 * edges.t.error) * kUp;
  outline.low = is_perspective_ ? least_w : std::min({a.distance, b.distance, c.distance});
  outline.high = std::max({a.distance, b.distance, c.distance});
  outline.widening = seen.w_shift;
  outline.nearest = outline.widened(outline.low, outline.high).first;
  return outline;
}

}  // namespace pipeline
