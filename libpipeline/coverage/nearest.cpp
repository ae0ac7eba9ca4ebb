#include "libpipeline/coverage/nearest.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pipeline {
namespace {

// Branch-free where a branch would be unpredictable: which vertex of a small triangle comes first, which of
// its edges is on the left.

bool is_lower(const Vec3& a, const Vec3& b) {
  const bool at_equal_x = (a.x == b.x) & (a.z < b.z);
  return (a.y < b.y) | ((a.y == b.y) & ((a.x < b.x) | at_equal_x));
}

/// The vertices from the lowest to the highest, equal ones in their order.
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

/// The three values divided by 2^exponent, which makes the largest one lie in [1/2, 1).
std::array<double, 3> scaled(const std::array<double, 3>& values, int& exponent) {
  const double largest = std::max({std::fabs(values[0]), std::fabs(values[1]), std::fabs(values[2])});
  exponent = largest == 0 ? 0 : std::ilogb(largest) + 1;
  return {std::ldexp(values[0], -exponent), std::ldexp(values[1], -exponent),
          std::ldexp(values[2], -exponent)};
}

struct Plane {
  double rise;   // slope = rise / area
  double area;   // twice the signed area of the triangle in x and y
  double terms;  // the sum of the absolute values of the two terms of `area`
};

Plane plane_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double forward = (b.x - a.x) * (c.y - a.y);
  const double backward = (c.x - a.x) * (b.y - a.y);
  const double rise = (b.z - a.z) * (c.y - a.y) - (c.z - a.z) * (b.y - a.y);
  return {rise, forward - backward, std::fabs(forward) + std::fabs(backward)};
}

/// dz/dx of the plane through three points, none where the triangle may be seen edge-on. One slope for all
/// rows: the quotient of the differences between the ends of a row has no correct digit where the row crosses
/// the triangle next to a corner.
std::optional<double> slope_in_x(const Vec3& a, const Vec3& b, const Vec3& c) {
  Plane plane = plane_of(a, b, c);
  int exponent = 0;
  if (!(plane.terms > 0x1p-900 && plane.terms < 0x1p900 && std::isfinite(plane.rise))) {
    // Products near the ends of a double's range: calculate with powers of two factored out.
    int x_exponent = 0, y_exponent = 0, z_exponent = 0;
    const auto x = scaled({a.x, b.x, c.x}, x_exponent);
    const auto y = scaled({a.y, b.y, c.y}, y_exponent);
    const auto z = scaled({a.z, b.z, c.z}, z_exponent);
    plane = plane_of({x[0], y[0], z[0]}, {x[1], y[1], z[1]}, {x[2], y[2], z[2]});
    exponent = z_exponent - x_exponent;
  }
  if (std::fabs(plane.area) <= NearestRows::kAreaError * plane.terms) return std::nullopt;
  const double unscaled = plane.rise / plane.area;
  const double slope = exponent == 0 ? unscaled : std::ldexp(unscaled, exponent);
  return std::isfinite(slope) ? std::optional(slope) : std::nullopt;
}

double interpolate(double from, double to, double t) {
  const double difference = to - from;
  // The first form is exact where both are equal, the second cannot overflow.
  return std::isfinite(difference) ? from + t * difference : (1 - t) * from + t * to;
}

}  // namespace

NearestRows::NearestRows(const PixelGrid& grid, const Triangle& p_ndc) : grid_(grid) {
  const Triangle p = sorted(p_ndc);
  edges_ = {Edge{p[0], p[1]}, Edge{p[1], p[2]}, Edge{p[0], p[2]}};
  slope_ = slope_in_x(p[0], p[1], p[2]);
  first_row_ = clamped_ceil((grid.top_y - p[2].y) / grid.dy, 0, grid.rows);
  last_row_ = clamped_floor((grid.top_y - p[0].y) / grid.dy, -1, grid.rows - 1);
}

NearestRows::Intersection NearestRows::intersect(const Edge& edge, double y) {
  const Vec3& lower = edge.lower;
  const Vec3& upper = edge.upper;
  // Exact at the corners, where two edges have to meet.
  if (y == upper.y) return {upper.x, upper.z};
  const double length = upper.y - lower.y;
  const double t =
      std::isfinite(length) ? (y - lower.y) / length : (y / 2 - lower.y / 2) / (upper.y / 2 - lower.y / 2);
  return {interpolate(lower.x, upper.x, t), interpolate(lower.z, upper.z, t)};
}

std::optional<NearestRows::Ends> NearestRows::ends(double y) const {
  const Edge& longest = edges_[2];
  const double middle_y = edges_[0].upper.y;
  const bool is_between_corners = (longest.lower.y <= y) & (y <= longest.upper.y) & (y != middle_y);
  if (!is_between_corners) return ends_at_corner(y);
  // The longest edge and, below or above the middle corner, one of the others.
  const std::array<Intersection, 2> points = {intersect(edges_[static_cast<std::size_t>(y > middle_y)], y),
                                              intersect(longest, y)};
  const auto& [first, second] = points;
  const bool is_lower_z = (second.x == first.x) & (second.z < first.z);
  return Ends{points[static_cast<std::size_t>((second.x < first.x) | is_lower_z)],
              points[static_cast<std::size_t>((second.x > first.x) | is_lower_z)]};
}

std::optional<NearestRows::Ends> NearestRows::ends_at_corner(double y) const {
  int count = 0;
  Intersection left = {}, right = {};
  for (const Edge& edge : edges_) {
    const bool is_horizontal = edge.lower.y == edge.upper.y;
    if (is_horizontal || y < edge.lower.y || y > edge.upper.y) continue;
    const Intersection point = intersect(edge, y);
    if (count == 0 || std::tie(point.x, point.z) < std::tie(left.x, left.z)) left = point;
    if (count == 0 || point.x > right.x || (point.x == right.x && point.z < right.z)) right = point;
    ++count;
  }
  return count < 2 ? std::nullopt : std::optional(Ends{left, right});
}

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
  if (slope_ && left.x < right.x)
    span.depth.slope = *slope_;
  else
    span.depth.z0 = std::min(left.z, right.z);
  return span;
}

}  // namespace pipeline
