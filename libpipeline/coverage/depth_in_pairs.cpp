#include "libpipeline/coverage/depth_in_pairs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace pipeline {
namespace {

/// The vertex opposite to the longest edge. Seen from there, what is far away spoils no digit of what is
/// near.
std::size_t nearest_to_the_others(const Triangle& p) {
  const auto length = [&](std::size_t i, std::size_t j) {
    return std::fabs(p[i].x - p[j].x) + std::fabs(p[i].y - p[j].y);
  };
  const std::array<double, 3> opposite = {length(1, 2), length(2, 0), length(0, 1)};
  return static_cast<std::size_t>(std::max_element(opposite.begin(), opposite.end()) - opposite.begin());
}

}  // namespace

DepthInPairs::DepthInPairs(const PixelGrid& grid, const Triangle& p_ndc)
    : half_width_(grid.half_width), half_height_(grid.half_height), columns_(grid.columns), rows_(grid.rows) {
  const std::size_t first = nearest_to_the_others(p_ndc);
  const Vec3 &a = p_ndc[first], &b = p_ndc[(first + 1) % 3], &c = p_ndc[(first + 2) % 3];
  origin_ = a;
  const DoubleDouble b_x = two_sum(b.x, -a.x), b_y = two_sum(b.y, -a.y), b_z = two_sum(b.z, -a.z);
  const DoubleDouble c_x = two_sum(c.x, -a.x), c_y = two_sum(c.y, -a.y), c_z = two_sum(c.z, -a.z);
  const DoubleDouble area = b_x * c_y - c_x * b_y;
  slope_ = (b_z * c_y - c_z * b_y) / area;
  slope_in_y_ = (b_x * c_z - c_x * b_z) / area;
  half_slope_ = (slope_ * half_width_ / DoubleDouble{static_cast<double>(columns_)}).hi;
}

std::optional<SpanDepth> DepthInPairs::along(int row, int first_column, int last_column) const {
  // The middle of the span, in pixels from the middle of the window.
  const double columns = first_column + last_column + 1 - columns_, rows = rows_ - 2 * row - 1;
  const DoubleDouble x = two_product(half_width_, columns) / DoubleDouble{static_cast<double>(columns_)};
  const DoubleDouble y = two_product(half_height_, rows) / DoubleDouble{static_cast<double>(rows_)};
  const DoubleDouble rise =
      slope_ * (x - DoubleDouble{origin_.x}) + slope_in_y_ * (y - DoubleDouble{origin_.y});
  const double middle = (rise + DoubleDouble{origin_.z}).hi;
  if (!std::isfinite(middle) || !std::isfinite(half_slope_)) return std::nullopt;
  return SpanDepth{0, 2, static_cast<double>(first_column + last_column), middle, half_slope_};
}

}  // namespace pipeline
