#include "libpipeline/certainty/uncertain_triangle.h"

#include <cmath>
#include <variant>

#include "libpipeline/numbers/vec_math.h"

// The proof, in homogeneous pixels (column * w, row * w, w): a center is d = (column, row, 1), the edges are
// planes n_i = p_j x p_k through the eye, their sum is `plane`, and n_0 . p_0 is `volume`, above 0 (M. Olano
// and T. Greer, Triangle Scan Conversion using 2D Homogeneous Coordinates, 1997). Possible: a true point seen
// at d is w' d. The point p of the same weights differs from it by the moves of the corners: `error` in view
// space, and printing. So |n . (p - w' d)| <= w' margin(n) for any plane n, as w' is at least least_w. Since
// n_i . p is from 0 to volume, n_i . d >= -margin(n_i). Sure: move the triangle continuously to the true one.
// The triangle stops covering d only when an edge meets d. There, n_i . p = 0 for the original edge, so |n_i
// . d| <= margin(n_i). Depths: from plane . p = volume follows 1 / w' = (plane . d + printed) / (volume -
// moved), where `moved` is due to `error` alone: printing moves points in proportion to w'. Rounding: no
// value here takes more than 30 roundings, of numbers that are at most the sum of the |terms|.

namespace pipeline {
namespace {

using Linear = UncertainTriangle::Linear;

constexpr double kInfinity = UncertainTriangle::kInfinity;
constexpr double kLost = 0x1p-48;      // more than sums and products here lose, relative to their |terms|
constexpr double kUnderflow = 1e-280;  // exceeds what products lose by underflow
constexpr double kMost = 1e60;         // a limit for numbers whose products must be finite
constexpr double kUp = ErrorBound::kRoundUp;

/// The pixels of an axis, of `count`, with centers from `low` to `high`.
RowRange pixels_between(double low, double high, int count) {
  return {count - static_cast<int>(count - std::clamp<double>(low, 0, count)),
          static_cast<int>(std::clamp<double>(high, -1, count - 1) + 1)};
}

Vec3 magnitudes(const Vec3& v) {
  return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)};
}

}  // namespace

struct UncertainView::Corners {
  /// A bound on the distance of true points from a plane, without the rounding of printing.
  [[nodiscard]] double moved(const Linear& plane) const {
    return dot(magnitudes(plane), by_axes) +
           by_w * (std::fabs(dot(plane, eye)) + kLost * dot(magnitudes(plane), magnitudes(eye)));
  }
  /// A bound on their distance due to printing and rounding, per w, for points whose w is at least `w`.
  [[nodiscard]] double printed_off(const Linear& plane, double w) const {
    return dot(magnitudes(plane), sum(printed_per_w, scaled(printed, 1 / w)));
  }
  [[nodiscard]] double margin(const Linear& plane, double w) const {
    return moved(plane) / w + printed_off(plane, w);
  }

  Triangle p;                       // in homogeneous pixels
  Vec3 eye = {0, 0, 1};             // the pixel straight in front of the eye
  std::array<double, 3> distances;  // of the corners in front of the eye
  double largest = 0;               // of all |numbers|
  double distance_error = 0;
  Vec3 by_axes = {};  // the move of p by `error` in x and y of view space, and in w
  double by_w = 0;
  Vec3 printed = {}, printed_per_w = {};
  double nearest_w = 1, farthest_w = 1;  // of the true triangle
  double least_w = 1;                    // of its points that are seen
};

struct UncertainView::Edges {
  /// `extent` is the largest column, the largest row, and 1.
  Edges(const Triangle& p, const Vec3& extent) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &a = p[(i + 1) % 3], &b = p[(i + 2) % 3], c = magnitudes(a), d = magnitudes(b);
      const Vec3 terms = {c.y * d.z + c.z * d.y, c.z * d.x + c.x * d.z, c.x * d.y + c.y * d.x};
      planes[i] = cross(a, b);
      lost[i] = kLost * dot(terms, extent) + kUnderflow;
      lost_volume = kLost * dot(magnitudes(p[i]), terms) + kUnderflow;
    }
    volume = dot(p[0], planes[0]);
    if (volume < 0)
      for (Linear& plane : planes) plane = scaled(plane, -1);
    volume = std::fabs(volume);
  }

  std::array<Linear, 3> planes;
  std::array<double, 3> lost;  // by rounding, of the planes' values
  double volume, lost_volume;
};

UncertainView::UncertainView(const Viewport& screen, const Bounds& bounds, const Projection& projected)
    : bounds_(bounds), is_perspective_(std::holds_alternative<Frustum>(projected)) {
  const auto set = [&](const auto& p) {
    near_ = p.near;
    far_ = p.far;
    const double size = is_perspective_ ? 2 * near_ : 2, width = p.right - p.left, height = p.top - p.bottom;
    axes_ = {Axis{&Vec3::x, &UncertainTriangle::columns, screen.left_x(), 1 / screen.dx(), screen.columns,
                  std::fabs(size / width), -(p.right + p.left) / width},
             Axis{&Vec3::y, &UncertainTriangle::rows, screen.top_y(), -1 / screen.dy(), screen.rows,
                  std::fabs(size / height), -(p.top + p.bottom) / height}};
  };
  if (is_perspective_)
    set(std::get<Frustum>(projected));
  else
    set(std::get<Orthographic>(projected));
  front_ = depths_at(screen.front);
  front_[1] = std::max(front_[1], is_perspective_ ? -1 / near_ : near_);  // nearer points may be cut
  if (!is_perspective_) return;
  // Triangles that come nearer than near / 1024 are cut at the near plane.
  least_shown_w_ = std::max(near_ / 1024, front_[0] < 0 ? -1 / front_[0] : kInfinity) / kUp;
  front_[0] = -1 / least_shown_w_;
}

std::array<double, 2> UncertainView::depths_at(double z) const {
  const double range = far_ - near_, sign = is_perspective_ ? -1 : 1;
  const double middle = z * range + sign * (far_ + near_);
  const double error = kLost * (std::fabs(z * range) + std::fabs(far_) + std::fabs(near_));
  const auto halved = [&](double depth) { return is_perspective_ ? depth / near_ / far_ / 2 : depth / 2; };
  if (!std::isfinite(error)) return {-kInfinity, kInfinity};
  return {halved(middle - error), halved(middle + error)};
}

UncertainView::Corners UncertainView::corners(const TriangleBatch& p_ndc, std::size_t index) const {
  Corners c;
  const ClipTriangle* const whole = p_ndc.unclipped_of(index);  // in clip space, with all digits
  const double range = far_ - near_;
  double largest_printed = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& p = whole != nullptr ? (*whole)[i].position : p_ndc.triangles[index][i];
    const double printed_w = whole != nullptr ? (*whole)[i].w : p_ndc.attributes.w[index][i];
    const double w = is_perspective_ ? printed_w : 1, to_clip = whole != nullptr ? 1 : w;
    c.p[i] = {p.x * to_clip, p.y * to_clip, w};
    c.distances[i] = is_perspective_ ? w : (p.z * range + far_ + near_) / 2;
    c.largest = std::max(c.largest, std::fabs(c.distances[i]));
    largest_printed = std::max({largest_printed, largest_in(p), whole != nullptr ? std::fabs(w) : 0});
  }
  const ErrorBound printing = whole != nullptr ? rounding_error(kShortest) : *bounds_.rounded;
  const double printed = printing.at(largest_printed) + kLost * largest_printed;
  const double largest_on_screen =
      place_on_screen(c, whole != nullptr ? printed : 0, whole != nullptr ? 0 : printed);
  if (!is_perspective_)
    c.distance_error = std::fabs(range) * printed / 2 +
                       kLost * (largest_printed * std::fabs(range) + std::fabs(far_) + std::fabs(near_));
  const double error = bounds_.error.at((c.largest + c.distance_error) * kUp) * kUp;
  c.distance_error = (c.distance_error + error) * kUp;
  c.by_axes = scaled(c.by_axes, error * kUp);
  c.largest = std::max({c.largest, largest_on_screen, error});
  if (!is_perspective_) return c;
  c.by_w = error * kUp;
  c.printed = sum(c.printed, scaled(c.printed_per_w, error));  // printed w: up to `error` larger
  const auto [least, greatest] = std::ranges::minmax(c.distances);
  c.nearest_w = least - error;
  c.farthest_w = greatest + error;
  c.least_w = std::max(c.nearest_w, least_shown_w_);
  return c;
}

/// Brings corners from clip space to homogeneous pixels, and returns the largest terms of these.
double UncertainView::place_on_screen(Corners& c, double printed_in_clip, double printed_in_ndc) const {
  double largest = 0;
  for (const Axis& axis : axes_) {
    const double per_ndc = std::fabs(axis.per_ndc);
    double terms = 0;
    for (Vec3& p : c.p) {
      const double clip = p.*axis.of, w = std::fabs(p.z), printed = printed_in_clip + printed_in_ndc * w;
      c.largest = std::max(c.largest, (std::fabs(clip) + printed + std::fabs(axis.center) * w) / axis.scale);
      terms = std::max(terms, std::fabs(clip) + std::fabs(axis.first) * w);
      p.*axis.of = (clip - axis.first * p.z) * axis.per_ndc;
    }
    largest = std::max(largest, terms * per_ndc);
    c.printed.*axis.of = (kLost * terms + printed_in_clip) * per_ndc;
    c.printed_per_w.*axis.of = printed_in_ndc * per_ndc + kLost * axis.count;
    c.eye.*axis.of = (axis.center - axis.first) * axis.per_ndc;
    c.by_axes.*axis.of = axis.scale * per_ndc;
  }
  return largest;
}

/// Narrows the columns and rows, and makes the corners' positions count from the first ones.
void UncertainView::set_box(UncertainTriangle& triangle, Corners& corners) const {
  for (const Axis& axis : axes_) {
    if (!(corners.nearest_w > 1 / kMost)) break;  // some have no place on the screen
    double low = kInfinity, high = -kInfinity;
    for (const Vec3& p : corners.p) {
      const double position = p.*axis.of / p.z;
      Linear from = {0, 0, -position};
      from.*axis.of = 1;
      const double off = corners.margin(from, corners.nearest_w);
      low = std::min(low, position - off);
      high = std::max(high, position + off);
    }
    triangle.*axis.range = pixels_between(low, high, axis.count);
  }
  const Vec3 first = {1.0 * triangle.columns.first, 1.0 * triangle.rows.first, 0};
  for (Vec3& p : corners.p) p = difference(p, scaled(first, p.z));
  corners.eye = difference(corners.eye, first);
}

void UncertainView::set_depths(UncertainTriangle& triangle, const Corners& c, const Edges& edges) const {
  const auto [least, greatest] = std::ranges::minmax(c.distances);
  const double base = is_perspective_ ? 0 : least, off_base = is_perspective_ ? 0 : c.distance_error;
  Linear plane;  // the depth is plane . d / volume + base
  double off_plane = 0, off_volume = edges.lost_volume;
  for (std::size_t i = 0; i < 3; ++i) {
    const double depth = is_perspective_ ? -1 : c.distances[i] - base;
    plane = sum(plane, scaled(edges.planes[i], depth));
    off_plane += std::fabs(depth) * edges.lost[i];
  }
  off_plane += c.printed_off(plane, c.least_w);
  if (is_perspective_) {
    off_volume += c.moved(plane);
    triangle.least = -(1 + kLost) / c.least_w;
    triangle.greatest = c.farthest_w > 0 ? -(1 - kLost) / c.farthest_w : -kInfinity;
  } else {
    off_plane += c.moved(plane) + 4 * (greatest - least) * edges.lost_volume;
    triangle.least = least - off_base;
    triangle.greatest = greatest + off_base;
  }
  const auto bound = [&](double sign) -> Linear {
    const double per_volume = (1 - sign * kLost) / (edges.volume + sign * off_volume);
    return sum(scaled(plane, per_volume), {0, 0, sign * (off_plane * per_volume + off_base) + base});
  };
  const bool has_volume = edges.volume - off_volume > kUnderflow;
  if (has_volume) triangle.nearest_plane = bound(-1);
  if (has_volume || is_perspective_) triangle.farthest_plane = bound(1);
}

UncertainTriangle UncertainView::triangle(const TriangleBatch& p_ndc, std::size_t index) const {
  UncertainTriangle triangle = {.columns = {0, axes_[0].count}, .rows = {0, axes_[1].count}};
  Corners c = corners(p_ndc, index);
  if (!(c.largest < kMost)) {  // the triangle may be anywhere
    triangle.add({{}, -kInfinity, kInfinity});
    return triangle;
  }
  set_box(triangle, c);
  const Vec3 extent = {1.0 * triangle.columns.end - triangle.columns.first,
                       1.0 * triangle.rows.end - triangle.rows.first, 1};
  if (extent.x <= 0) triangle.rows.end = triangle.rows.first;
  if (triangle.rows.end <= triangle.rows.first) return triangle;
  const Edges edges(c.p, extent);
  for (std::size_t i = 0; i < 3; ++i) {
    const double margin = c.margin(edges.planes[i], c.least_w) + edges.lost[i];
    triangle.add({edges.planes[i], -margin - edges.lost_volume / c.least_w, margin});
  }
  set_depths(triangle, c, edges);
  if (triangle.greatest < front_[0]) triangle.rows.end = triangle.rows.first;
  if (triangle.least <= front_[1]) {
    triangle.add({triangle.farthest_plane, front_[0], -kInfinity});
    triangle.add({triangle.nearest_plane, -kInfinity, front_[1]});
    triangle.least = std::max(triangle.least, front_[0]);
  }
  return triangle;
}

UncertainTriangle::Row UncertainTriangle::row(int row) const {
  const int count = columns.end - columns.first, y = row - rows.first;
  struct {
    double low, high;
  } possible = {0, count - 1.0}, sure = possible;
  for (std::size_t i = 0; i < side_count; ++i) {
    const Side& side = sides[i];
    const double at_0 = side.inside.y * y + side.inside.z, per_column = side.inside.x;
    const double possible_from = (side.possible_from - at_0) / per_column;
    const double sure_from = (side.sure_from - at_0) / per_column;
    if (per_column > 0) {
      possible.low = std::max(possible.low, possible_from);
      sure.low = std::max(sure.low, sure_from);
    } else if (per_column < 0) {
      possible.high = std::min(possible.high, possible_from);
      sure.high = std::min(sure.high, sure_from);
    } else {
      if (at_0 < side.possible_from) possible.high = -1;
      if (at_0 <= side.sure_from) sure.high = -1;
    }
  }
  return {pixels_between(possible.low, possible.high, count), pixels_between(sure.low, sure.high, count),
          nearest_plane.y * y + nearest_plane.z, farthest_plane.y * y + farthest_plane.z};
}

}  // namespace pipeline
