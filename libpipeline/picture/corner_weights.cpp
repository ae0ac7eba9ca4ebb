#include "libpipeline/picture/corner_weights.h"

#include <cmath>

#include "libpipeline/numbers/exact_sum.h"
#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

// Below this, products of doubles lose digits.
constexpr double kLeastDoubt = 0x1p-900;

/// Twice the signed area of the triangle of p, q and a pixel's center, times the count of pixels, exact but
/// for one rounding. If `are_divided` by w, x and y are in NDC.
Ball exact_area(const Vec3& p, const Vec3& q, const PixelGrid& grid, int row, int column, bool are_divided) {
  const double columns = grid.columns, rows = grid.rows;
  const double right = 2.0 * column + 1 - columns,
               up = rows - 2.0 * row - 1;  // in half pixels, from the middle
  const double p_w = are_divided ? 1 : p.z, q_w = are_divided ? 1 : q.z;
  const double x_unit = rows * right, y_unit = columns * up;
  const Ball area = exact_sum({{columns * rows, p.x, q.y},
                               {-columns * rows, p.y, q.x},
                               {-y_unit, grid.half_height, p.x, q_w},
                               {y_unit, grid.half_height, q.x, p_w},
                               {-x_unit, grid.half_width, q.y, p_w},
                               {x_unit, grid.half_width, p.y, q_w}});
  return are_divided ? area * p.z * q.z : area;
}

/// A bound on the sum of the terms of an area at any pixel.
double terms(const Vec3& p, const Vec3& q, const PixelGrid& grid) {
  const auto x = [&](const Vec3& v) { return std::fabs(v.x) + grid.half_width * std::fabs(v.z); };
  const auto y = [&](const Vec3& v) { return std::fabs(v.y) + grid.half_height * std::fabs(v.z); };
  return x(p) * y(q) + y(p) * x(q);
}

/// The corners' x, y and w (in z) of clip space. Only ratios count: the scaling keeps all within a double's
/// range.
Triangle screen_corners_of(const ClipTriangle& corners, bool are_divided) {
  const auto& [a, b, c] = corners;
  const double scale = 1 / std::max({std::fabs(a.w), std::fabs(b.w), std::fabs(c.w)});
  const auto screen_corner = [&](const VertexLine& corner) {
    const Vec3 p = are_divided ? scaled(corner.position, corner.w) : corner.position;
    return scaled({p.x, p.y, corner.w}, scale);
  };
  return {screen_corner(a), screen_corner(b), screen_corner(c)};
}

}  // namespace

CornerWeights::CornerWeights(const PixelGrid& grid, const ClipTriangle& corners, bool are_divided)
    : scaled_(screen_corners_of(corners, are_divided)), are_divided_(are_divided) {
  for (std::size_t v = 0; v < 3; ++v)
    corners_[v] = {corners[v].position.x, corners[v].position.y, corners[v].w};
  const auto& [a, b, c] = scaled_;
  doubt_ = are_divided && are_plain(grid)
               ? -1
               : terms(a, b, grid) + terms(b, c, grid) + terms(c, a, grid) + kLeastDoubt;
}

/// True if doubles are enough at every pixel. The error of an area is within 2^-48 times its two w, the
/// largest coordinate and the length of an edge; the sum is at least the area in NDC times the two smaller w.
/// Near the ends of a double's range, either may overflow or vanish.
bool CornerWeights::are_plain(const PixelGrid& grid) const {
  const auto is_usual = [](double x) { return x > 0x1p-300 && x < 0x1p300; };
  const auto& [a, b, c] = corners_;
  const auto [least_w, largest_w] = std::minmax({a.z, b.z, c.z});
  const Vec3 ab = difference(b, a), ac = difference(c, a);
  const double length = std::max({std::fabs(ab.x), std::fabs(ab.y), std::fabs(ac.x), std::fabs(ac.y)}) +
                        std::max(grid.dx, grid.dy);
  const double reach = std::max({grid.half_width, grid.half_height, std::fabs(a.x), std::fabs(a.y)}) + length;
  return is_usual(reach) && is_usual(largest_w) &&
         reach * length * largest_w <= 0x1p13 * std::fabs(ab.x * ac.y - ab.y * ac.x) * least_w;
}

// L3
CornerWeights::Weights CornerWeights::exactly_at(const PixelGrid& grid, int row, int column) const {
  const auto area = [&](std::size_t p, std::size_t q) {
    return exact_area(corners_[p], corners_[q], grid, row, column, are_divided_);
  };
  std::array<Ball, 3> weights = {area(1, 2), area(2, 0), area(0, 1)};
  const bool is_negative = (weights[0] + weights[1] + weights[2]).sign() < 0;
  for (Ball& weight : weights) {
    if (is_negative) weight = -weight;
    if (weight.sign() < 0) weight = Ball(0);
  }
  if (std::ranges::all_of(weights, &Ball::is_exact_zero)) return {1, 0, 0};
  const Ball sum = weights[0] + weights[1] + weights[2];
  const auto share = [&](const Ball& weight) { return (weight / sum).nearest_double(); };
  return {share(weights[0]), share(weights[1]), share(weights[2])};
}

}  // namespace pipeline
