#include "libpipeline/certainty/uncertain_polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

// The proof. A vertex in view space is within `error` of the true one, and so is each point of the triangle
// of the one with the same weights; its w is within `w_error`. With x = (scale * view_x + center * w) / w,
// the true x differs from x by (scale * dx + (center - x) * dw) / (w + dw), which is at most (scale + |center
// - x|)
// * error / (least w - w_error). To this comes what printing moved, by `printed` (for a triangle that was
// cut, in clip space, so divided by w). A point that can be seen is not nearer than least_shown_w_, and
// inside the window; the point that belongs to it is kept by planes that much farther out. Depths: 1 / (w +
// dw) is within w_error / (least w - w_error) of 1 / w, as a part of it.
//
// Rounding. Dividing by w, and by the size of a pixel, takes at most 16 roundings of numbers that are no
// larger than the position and the count of cells: below kRounding. A cut's point is off by at most 2^-49 of
// the largest coordinate, and is cut five times at most: below kCutRounding.

namespace pipeline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLost = 0x1p-49;  // more than sums of a few doubles lose, in parts of the largest one
constexpr double kRounding = 0x1p-48, kCutRounding = 0x1p-46;
constexpr double kUp = ErrorBound::kRoundUp;
constexpr double kFarOff = 1e9;                   // in pixels
constexpr double kLeast = 1e-200, kMost = 1e200;  // between these, no product is lost

/// A point in clip space, and its distance in front of the eye.
struct ClipPoint {
  std::array<double, 2> p;
  double w, distance;
};

ClipPoint between(const ClipPoint& a, const ClipPoint& b, double t) {
  const auto at = [t](double from, double to) { return from + t * (to - from); };
  return {{at(a.p[0], b.p[0]), at(a.p[1], b.p[1])}, at(a.w, b.w), at(a.distance, b.distance)};
}

}  // namespace

struct UncertainView::Vertices {
  std::array<ClipPoint, 3> at;
  double printed_per_w = 0, printed = 0;  // how far x and y in clip space were moved by printing
  double largest = 0;                     // of the |numbers| in `at`
  double error = 0, w_error = 0, distance_error = 0;
};

struct UncertainView::ClipPolygon {
  /// Keeps the part where `inside`, a linear function, is at least 0 (I. Sutherland and G. Hodgman, 1974).
  template <typename Inside>
  void cut(Inside&& inside) {
    const auto is_inside = [&](const ClipPoint& at) { return inside(at) >= 0; };
    if (std::all_of(points.begin(), points.begin() + count, is_inside)) return;
    std::array<double, UncertainPolygon::kMaxPoints> values;
    for (std::size_t i = 0; i < count; ++i) values[i] = inside(points[i]);
    const auto old = points;
    const std::size_t old_count = count;
    count = 0;
    for (std::size_t i = 0; i < old_count; ++i) {
      const std::size_t next = i + 1 == old_count ? 0 : i + 1;
      if (values[i] >= 0) points[count++] = old[i];
      if ((values[i] > 0 && values[next] < 0) || (values[i] < 0 && values[next] > 0))
        points[count++] = between(old[i], old[next], values[i] / (values[i] - values[next]));
    }
    is_cut = true;
  }

  std::array<ClipPoint, UncertainPolygon::kMaxPoints> points;
  std::size_t count = 3;
  bool is_cut = false;
};

UncertainView::UncertainView(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : bounds_(bounds), is_perspective_(std::holds_alternative<Frustum>(projected)) {
  const auto axis = [&](double low, double high, double first, double step, int cell_count) {
    const std::array ends = {first - 1.5 * step, first + (cell_count + 0.5) * step};
    return Axis{first,
                1 / step,
                static_cast<double>(cell_count),
                std::min(ends[0], ends[1]),
                std::max(ends[0], ends[1]),
                std::fabs((is_perspective_ ? 2 * near_ : 2) / (high - low)),
                -(high + low) / (high - low)};
  };
  const auto set = [&](const auto& p) {
    near_ = p.near;
    far_ = p.far;
    axes_ = {axis(p.left, p.right, screen.left_x(), screen.dx(), screen.columns),
             axis(p.bottom, p.top, screen.top_y(), -screen.dy(), screen.rows)};
  };
  if (is_perspective_)
    set(std::get<Frustum>(projected));
  else
    set(std::get<Orthographic>(projected));
  if (!is_perspective_) return;
  const double front = depths_at(screen.front)[0];
  // Triangles that come nearer than near / 1024 are cut at the near plane.
  least_shown_w_ = std::max(near_ / 1024, front < 0 ? -1 / front : kInfinity) / kUp;
}

std::array<double, 2> UncertainView::depths_at(double z) const {
  const double range = far_ - near_, sign = is_perspective_ ? -1 : 1;
  const double middle = z * range + sign * (far_ + near_);
  const double error = kLost * (std::fabs(z * range) + std::fabs(far_) + std::fabs(near_));
  const auto scaled = [&](double depth) { return is_perspective_ ? depth / near_ / far_ / 2 : depth / 2; };
  if (!std::isfinite(error)) return {-kInfinity, kInfinity};
  return {scaled(middle - error), scaled(middle + error)};
}

UncertainView::Vertices UncertainView::vertices(const TriangleBatch& p_ndc, std::size_t index) const {
  Vertices v;
  const ClipTriangle* const whole = p_ndc.unclipped_of(index);  // in clip space, with all digits
  const double range = far_ - near_;
  double largest_printed = 0, largest_in_view = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = whole != nullptr ? (*whole)[i].position : p_ndc.triangles[index][i];
    const double printed_w = whole != nullptr ? (*whole)[i].w : p_ndc.attributes.w[index][i];
    const double w = is_perspective_ ? printed_w : 1, to_clip = whole != nullptr ? 1 : w;
    v.at[i] = {{p.x * to_clip, p.y * to_clip}, w, is_perspective_ ? w : (p.z * range + far_ + near_) / 2};
    for (const double printed : {p.x, p.y, p.z, whole != nullptr ? printed_w : 0})
      largest_printed = std::max(largest_printed, std::fabs(printed));
    for (const double number : {v.at[i].p[0], v.at[i].p[1], w, v.at[i].distance})
      v.largest = std::max(v.largest, std::fabs(number));
  }
  const ErrorBound printing = whole != nullptr ? rounding_error(kShortest) : *bounds_.rounded;
  const double printed = printing.at(largest_printed) + kLost * largest_printed;
  (whole != nullptr ? v.printed : v.printed_per_w) = printed;
  for (const ClipPoint& at : v.at) {
    largest_in_view = std::max(largest_in_view, std::fabs(at.distance));
    for (std::size_t k = 0; k < 2; ++k) {
      const double w = std::fabs(at.w), moved = v.printed + v.printed_per_w * w;
      largest_in_view = std::max(
          largest_in_view, (std::fabs(at.p[k]) + moved + std::fabs(axes_[k].center) * w) / axes_[k].scale);
    }
  }
  if (!is_perspective_)
    v.distance_error = std::fabs(range) * printed / 2 +
                       kLost * (largest_printed * std::fabs(range) + std::fabs(far_) + std::fabs(near_));
  v.error = bounds_.error.at((largest_in_view + v.distance_error) * kUp) * kUp;
  v.w_error = is_perspective_ ? v.error : 0;
  v.distance_error = (v.distance_error + v.error) * kUp;
  return v;
}

/// Cuts away what cannot be seen. False if w may be too small for that, or numbers are too large.
bool UncertainView::cut(ClipPolygon& polygon, const Vertices& v) const {
  if (is_perspective_) {
    const double least_w = std::min(std::min(v.at[0].w, v.at[1].w), v.at[2].w);
    const double limit = std::max(least_w, least_shown_w_ - v.w_error);
    if (!(limit > std::max(2 * v.w_error, kLeast))) return false;
    if (limit > least_w) polygon.cut([&](const ClipPoint& at) { return at.w - limit; });
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Axis& axis = axes_[k];
    const double low = axis.low - v.printed_per_w, high = axis.high + v.printed_per_w;
    const double turn = is_perspective_ ? std::max(axis.center - low, high - axis.center) : 0;
    // Twice as far out as needed, so that centers in the window are surely inside of these cuts.
    const double farther = 2 * (axis.scale + std::max(turn, 0.0)) * v.error + v.printed +
                           kLost * v.largest * (1 + std::max(std::fabs(low), std::fabs(high)));
    if (!(farther < kMost)) return false;
    polygon.cut([&](const ClipPoint& at) { return at.p[k] - low * at.w + farther; });
    polygon.cut([&](const ClipPoint& at) { return high * at.w - at.p[k] + farther; });
  }
  return true;
}

UncertainPolygon UncertainView::on_screen(const ClipPolygon& polygon, const Vertices& v) const {
  UncertainPolygon seen;
  if (polygon.count == 0) return seen;
  const double cut_error = polygon.is_cut ? kCutRounding * v.largest : 0;
  double least_w = kInfinity;
  std::array<double, 2> largest = {}, turn = {}, largest_position = {};
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const ClipPoint& at = polygon.points[i];
    const double per_w = 1 / at.w;
    least_w = std::min(least_w, at.w);
    std::array<double, 2> position;
    for (std::size_t k = 0; k < 2; ++k) {
      const double ndc = at.p[k] * per_w;
      position[k] = (ndc - axes_[k].first) * axes_[k].per_step;
      largest[k] = std::max(largest[k], std::fabs(ndc));
      turn[k] = std::max(turn[k], std::fabs(axes_[k].center - ndc));
      largest_position[k] = std::max(largest_position[k], std::fabs(position[k]));
    }
    seen.points[i] = {position[0], position[1], is_perspective_ ? -per_w : at.distance};
  }
  const double per_true_w = is_perspective_ ? kUp / (least_w - v.w_error - cut_error) : 1;
  std::array<double, 2> off;
  for (std::size_t k = 0; k < 2; ++k) {
    const Axis& axis = axes_[k];
    const double by_turn = is_perspective_ ? turn[k] + kLost * (largest[k] + std::fabs(axis.center)) : 0;
    const double moved = ((axis.scale + by_turn) * v.error + v.printed) * per_true_w + v.printed_per_w;
    const double rounding = kRounding * (largest_position[k] + axis.cell_count) +
                            cut_error * (1 + largest[k]) * per_true_w * std::fabs(axis.per_step);
    off[k] = (moved * std::fabs(axis.per_step) + rounding) * kUp;
    seen.rounding = std::max(seen.rounding, rounding);
    if (!(largest_position[k] + off[k] < kFarOff)) seen.is_anywhere = true;
  }
  if (!(per_true_w > 0)) seen.is_anywhere = true;
  seen.count = polygon.count;
  seen.columns_off = off[0];
  seen.rows_off = off[1];
  seen.depth_off = is_perspective_ ? ErrorBound{0, ((v.w_error + cut_error) * per_true_w + kLost) * kUp}
                                   : ErrorBound{(v.distance_error + cut_error) * kUp, 0};
  return seen;
}

UncertainPolygon UncertainView::polygon(const TriangleBatch& p_ndc, std::size_t index) const {
  const Vertices v = vertices(p_ndc, index);
  ClipPolygon polygon;
  std::ranges::copy(v.at, polygon.points.begin());
  if (cut(polygon, v)) return on_screen(polygon, v);
  UncertainPolygon anywhere;
  anywhere.is_anywhere = true;
  return anywhere;
}

}  // namespace pipeline
