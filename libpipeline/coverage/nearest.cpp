#include "libpipeline/coverage/nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// The vertex opposite to the longest edge: from there, no far vertex spoils the digits of a near one.
std::size_t nearest_to_the_others(const Triangle& p) {
  const auto length = [&](std::size_t i, std::size_t j) {
    return std::fabs(p[i].x - p[j].x) + std::fabs(p[i].y - p[j].y);
  };
  const std::array<double, 3> opposite = {length(1, 2), length(2, 0), length(0, 1)};
  return static_cast<std::size_t>(std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
}

}  // namespace

DepthInPairs::DepthInPairs(const PixelGrid& grid, const Triangle& p_ndc) : grid_(grid) {
  const std::size_t first = nearest_to_the_others(p_ndc);
  const Vec3 &a = p_ndc[first], &b = p_ndc[(first + 1) % 3], &c = p_ndc[(first + 2) % 3];
  origin_ = a;
  const DoubleDouble b_x = two_sum(b.x, -a.x), b_y = two_sum(b.y, -a.y), b_z = two_sum(b.z, -a.z);
  const DoubleDouble c_x = two_sum(c.x, -a.x), c_y = two_sum(c.y, -a.y), c_z = two_sum(c.z, -a.z);
  const DoubleDouble area = b_x * c_y - c_x * b_y;
  slope_ = (b_z * c_y - c_z * b_y) / area;
  slope_in_y_ = (b_x * c_z - c_x * b_z) / area;
  half_slope_ = (slope_ * grid_.half_width / DoubleDouble{static_cast<double>(grid_.columns)}).hi;
}

std::optional<SpanDepth> DepthInPairs::along(int row, int first_column, int last_column) const {
  // The middle of the span, in pixels from the middle of the window.
  const double columns = first_column + last_column + 1 - grid_.columns, rows = grid_.rows - 2 * row - 1;
  const DoubleDouble x =
      two_product(grid_.half_width, columns) / DoubleDouble{static_cast<double>(grid_.columns)};
  const DoubleDouble y = two_product(grid_.half_height, rows) / DoubleDouble{static_cast<double>(grid_.rows)};
  const DoubleDouble rise =
      slope_ * (x - DoubleDouble{origin_.x}) + slope_in_y_ * (y - DoubleDouble{origin_.y});
  const double middle = (rise + DoubleDouble{origin_.z}).hi;
  if (!std::isfinite(middle) || !std::isfinite(half_slope_)) return std::nullopt;
  return SpanDepth{0, 2, static_cast<double>(first_column + last_column), middle, half_slope_};
}

namespace {

// The code below avoids unpredictable branches: on the order of a small triangle's vertices, and on which
// edge is on the left.

bool is_lower(const Vec3& a, const Vec3& b) {
  const bool at_equal_x = (a.x == b.x) & (a.z < b.z);
  return (a.y < b.y) | ((a.y == b.y) & ((a.x < b.x) | at_equal_x));
}

/// The vertices from the lowest to the highest, equal ones in their given order.
Triangle sorted(const Triangle& p) {
  const unsigned b_first = is_lower(p[1], p[0]), c_before_a = is_lower(p[2], p[0]),
                 c_before_b = is_lower(p[2], p[1]);
  Triangle result;
  result[b_first + c_before_a] = p[0];
  result[1 - b_first + c_before_b] = p[1];
  result[2 - c_before_a - c_before_b] = p[2];
  return result;
}

/// floor(value) or ceil(value), which may be infinite, as an integer in [low, high]. (Without SSE4.1 the
/// library's are function calls.)
int clamped_floor(double value, int low, int high) {
  if (value < low) return low;
  if (value >= high) return high;
  const int towards_zero = static_cast<int>(value);
  return towards_zero - static_cast<int>(value < towards_zero);
}
int clamped_ceil(double value, int low, int high) {
  if (value <= low) return low;
  if (value >= high) return high;
  const int towards_zero = static_cast<int>(value);
  return towards_zero + static_cast<int>(towards_zero < value);
}

/// The three values divided by 2^exponent, so that the largest lies in [1/2, 1).
std::array<double, 3> scaled(const std::array<double, 3>& values, int& exponent) {
  const double largest = std::max({std::fabs(values[0]), std::fabs(values[1]), std::fabs(values[2])});
  exponent = largest == 0 ? 0 : std::ilogb(largest) + 1;
  return {std::ldexp(values[0], -exponent), std::ldexp(values[1], -exponent),
          std::ldexp(values[2], -exponent)};
}

/// A triangle's plane, given by the vectors b and c from its lowest vertex to the others.
struct Plane {
  Vec3 b;
  Vec3 c;
  double rise;   // slope = rise / area
  double area;   // twice the signed area of the triangle in x and y
  double terms;  // the sum of the absolute values of the two terms of `area`

  /// True if no product is so near the ends of a double's range that it may have lost digits.
  [[nodiscard]] bool is_in_range() const {
    return terms > 0x1p-900 && terms < 0x1p900 && std::isfinite(rise);
  }
  [[nodiscard]] bool is_seen_edge_on() const { return std::fabs(area) <= NearestRows::kAreaError * terms; }
  /// True if depths are to be calculated in pairs; `size` is the sum of the vertices' |z|.
  [[nodiscard]] bool needs_pairs(const PixelGrid& grid, double size) const {
    const double rise_in_y = b.x * c.z - c.x * b.z;
    const double reach_in_x = grid.half_width + (std::fabs(b.x) + std::fabs(c.x));
    const double reach_in_y = grid.half_height + c.y;
    const double change = std::fabs(rise) * reach_in_x + std::fabs(rise_in_y) * reach_in_y;
    const double net_area =
        std::fabs(area) - NearestRows::kNarrowest * terms - NearestRows::kNarrowestRow * grid.dx * c.y;
    return !(change <= std::min(NearestRows::kSteepest * size * net_area, NearestRows::kHuge));
  }
};

Plane plane_of(const Vec3& lowest, const Vec3& middle, const Vec3& highest) {
  const Vec3 b = difference(middle, lowest), c = difference(highest, lowest);
  const double forward = b.x * c.y, backward = c.x * b.y;
  return {b, c, b.z * c.y - c.z * b.y, forward - backward, std::fabs(forward) + std::fabs(backward)};
}

/// dz/dx of a triangle with products near the ends of a double's range, with powers of two factored out; none
/// if it may be seen edge-on.
[[gnu::noinline]] std::optional<double> slope_of_scaled(const Vec3& a, const Vec3& b, const Vec3& c) {
  int x_exponent = 0, y_exponent = 0, z_exponent = 0;
  const auto x = scaled({a.x, b.x, c.x}, x_exponent);
  const auto y = scaled({a.y, b.y, c.y}, y_exponent);
  const auto z = scaled({a.z, b.z, c.z}, z_exponent);
  const Plane plane = plane_of({x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]});
  if (plane.is_seen_edge_on()) return std::nullopt;
  const double slope = std::ldexp(plane.rise / plane.area, z_exponent - x_exponent);
  return std::isfinite(slope) ? std::optional(slope) : std::nullopt;
}

// Z2b
double interpolate(double from, double to, double t) {
  const double difference = to - from;
  // The first form is exact if both are equal; the second cannot overflow.
  return std::isfinite(difference) ? from + t * difference : (1 - t) * from + t * to;
}

}  // namespace

NearestRows::NearestRows(const PixelGrid& grid, const Triangle& p_ndc) : grid_(grid), p_(sorted(p_ndc)) {
  const auto& [a, b, c] = p_;
  const Plane plane = plane_of(a, b, c);
  if (!plane.is_in_range()) {
    slope_ = slope_of_scaled(a, b, c);
  } else if (!plane.is_seen_edge_on()) {
    const double slope = plane.rise / plane.area;
    if (std::isfinite(slope)) slope_ = slope;
    if (plane.needs_pairs(grid, std::fabs(a.z) + std::fabs(b.z) + std::fabs(c.z)))
      in_pairs_.emplace(grid, p_);
  }
  first_row_ = clamped_ceil((grid.top_y - c.y) / grid.dy, 0, grid.rows);
  last_row_ = clamped_floor((grid.top_y - a.y) / grid.dy, -1, grid.rows - 1);
}

inline NearestRows::Intersection NearestRows::intersect(const Vec3& lower, const Vec3& upper, double y) {
  // Exact at the corners, where two edges must meet.
  if (y == upper.y) return {upper.x, upper.z};
  const double length = upper.y - lower.y;
  const double t =
      std::isfinite(length) ? (y - lower.y) / length : (y / 2 - lower.y / 2) / (upper.y / 2 - lower.y / 2);
  return {interpolate(lower.x, upper.x, t), interpolate(lower.z, upper.z, t)};
}

std::optional<NearestRows::Ends> NearestRows::ends(double y) const {
  const double lowest_y = p_[0].y, middle_y = p_[1].y, highest_y = p_[2].y;
  const bool is_between_corners = (lowest_y <= y) & (y <= highest_y) & (y != middle_y);
  if (!is_between_corners) return ends_at_corner(y);
  // The longest edge and, below or above the middle corner, one of the others.
  const Vec3* const shorter = &p_[static_cast<std::size_t>(y > middle_y)];
  const std::array<Intersection, 2> points = {intersect(shorter[0], shorter[1], y),
                                              intersect(p_[0], p_[2], y)};
  const auto& [first, second] = points;
  const bool is_lower_z = (second.x == first.x) & (second.z < first.z);
  return Ends{points[static_cast<std::size_t>((second.x < first.x) | is_lower_z)],
              points[static_cast<std::size_t>((second.x > first.x) | is_lower_z)]};
}

std::optional<NearestRows::Ends> NearestRows::ends_at_corner(double y) const {
  int count = 0;
  Intersection left = {}, right = {};
  for (const auto& [from, to] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 2)}) {
    const Vec3& lower = p_[static_cast<std::size_t>(from)];
    const Vec3& upper = p_[static_cast<std::size_t>(to)];
    const bool is_horizontal = lower.y == upper.y;
    if (is_horizontal || y < lower.y || y > upper.y) continue;
    const Intersection point = intersect(lower, upper, y);
    if (count == 0 || std::tie(point.x, point.z) < std::tie(left.x, left.z)) left = point;
    if (count == 0 || point.x > right.x || (point.x == right.x && point.z < right.z)) right = point;
    ++count;
  }
  return count < 2 ? std::nullopt : std::optional(Ends{left, right});
}

// Z2, Z3
std::optional<Span> NearestRows::span(int row) const {
  const auto both = ends(grid_.y_of(row));
  if (!both) return std::nullopt;
  const auto& [left, right] = *both;
  Span span = {row,
               clamped_floor((left.x - grid_.left_x) / grid_.dx + 0.5, 0, grid_.columns),
               clamped_floor((right.x - grid_.left_x) / grid_.dx + 0.5, -1, grid_.columns - 1),
               {}};
  if (span.first_column > span.last_column) return std::nullopt;
  span.depth = {grid_.left_x, grid_.dx, left.x, left.z, 0};
  if (slope_ && left.x < right.x) {
    span.depth.slope = *slope_;
    if (in_pairs_) return refined(span);
  } else {
    span.depth.z0 = std::min(left.z, right.z);
  }
  return span;
}

// Z4
Span NearestRows::refined(Span span) const {
  if (const auto depth = in_pairs_->along(span.row, span.first_column, span.last_column)) span.depth = *depth;
  return span;
}

}  // namespace pipeline
