#include "libpipeline/certainty/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

// The proof. If a true point is seen at a center, its point of the polygon is within (columns_off, rows_off),
// so no side has the center farther outside than that: `margin`, which also has what rounding may have made
// of the polygon's angles. If the center is farther inside than that from all sides, the polygon's border
// winds around it; and on the way from each point of the border to its true one it never meets the center. So
// the true border winds around it, too, and the triangle covers it.
//
// The depth at the center is that of a point of the polygon so near, so it differs by `depth_margin` at most
// from the plane there; no matter which plane that is, as the points' distances from it are counted.

namespace pipeline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLost = 0x1p-49;  // more than sums of a few doubles lose, in parts of the largest one

/// The pixels of an axis with centers from `low` to `high`, out of `count`.
RowRange pixels_between(double low, double high, int count) {
  return {count - static_cast<int>(count - std::clamp<double>(low, 0, count)),
          static_cast<int>(std::clamp<double>(high, -1, count - 1) + 1)};
}

}  // namespace

Outline::Outline(const UncertainPolygon& polygon, int columns, int rows)
    : columns_{0, columns}, rows_{0, rows}, least_(-kInfinity), greatest_(kInfinity) {
  if (polygon.is_anywhere) {
    sides_[side_count_++] = {{}, -kInfinity, kInfinity};
    nearest_.at_0 = -kInfinity;
    farthest_.at_0 = kInfinity;
    return;
  }
  double left = kInfinity, right = -kInfinity, top = kInfinity, bottom = -kInfinity;
  double least = kInfinity, greatest = -kInfinity;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const auto& [column, row, depth] = polygon.points[i];
    left = std::min(left, column);
    right = std::max(right, column);
    top = std::min(top, row);
    bottom = std::max(bottom, row);
    least = std::min(least, depth);
    greatest = std::max(greatest, depth);
  }
  columns_ = pixels_between(left - polygon.columns_off, right + polygon.columns_off, columns);
  rows_ = pixels_between(top - polygon.rows_off, bottom + polygon.rows_off, rows);
  if (columns_.first >= columns_.end) rows_.end = rows_.first;
  least_ = least - polygon.depth_off.at(std::fabs(least));
  greatest_ = greatest + polygon.depth_off.at(std::fabs(greatest));
  const double width = right - left + 2 * polygon.columns_off, height = bottom - top + 2 * polygon.rows_off;
  set_sides(polygon, width, height);
  set_depths(polygon, width, height);
}

void Outline::set_sides(const UncertainPolygon& polygon, double width, double height) {
  double area = 0;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const auto &a = polygon.points[i], &b = polygon.points[i + 1 == polygon.count ? 0 : i + 1];
    const double column = a.column - columns_.first, row = a.row - rows_.first;
    const double per_column = a.row - b.row, per_row = b.column - a.column;
    const double margin = std::fabs(per_column) * polygon.columns_off +
                          std::fabs(per_row) * polygon.rows_off + 4 * polygon.rounding * (width + height);
    sides_[side_count_++] = {{per_column, per_row, -per_column * column - per_row * row}, -margin, margin};
    area += (column + (b.column - columns_.first)) * -per_column;
  }
  if (area > 0) return;
  for (std::size_t i = 0; i < side_count_; ++i) {
    Linear& inside = sides_[i].inside;
    inside = {-inside.per_column, -inside.per_row, -inside.at_0};
  }
}

void Outline::set_depths(const UncertainPolygon& polygon, double width, double height) {
  const auto& p = polygon.points;
  const std::size_t second = polygon.count / 3, third = 2 * polygon.count / 3;
  const auto &a = p[0], &b = p[second], &c = p[third];
  const double area = (b.column - a.column) * (c.row - a.row) - (c.column - a.column) * (b.row - a.row);
  Linear plane = {
      ((b.depth - a.depth) * (c.row - a.row) - (c.depth - a.depth) * (b.row - a.row)) / area,
      ((c.depth - a.depth) * (b.column - a.column) - (b.depth - a.depth) * (c.column - a.column)) / area, 0};
  if (!(std::fabs(plane.per_column) * width + std::fabs(plane.per_row) * height < kInfinity)) plane = {};
  const auto on_plane = [&](const UncertainPolygon::Point& at) {
    return plane.at(at.column - columns_.first, at.row - rows_.first);
  };
  plane.at_0 = a.depth - on_plane(a);
  const double slope = std::fabs(plane.per_column) * width + std::fabs(plane.per_row) * height;
  double off_plane = 0;
  for (std::size_t i = 0; i < polygon.count; ++i)
    off_plane = std::max(off_plane, std::fabs(p[i].depth - on_plane(p[i])));
  const double depth_margin = std::fabs(plane.per_column) * polygon.columns_off +
                              std::fabs(plane.per_row) * polygon.rows_off + off_plane +
                              kLost * (slope + std::fabs(least_) + std::fabs(greatest_));
  const ErrorBound& off = polygon.depth_off;
  const double nearer = 1 + off.relative * ErrorBound::kRoundUp, farther = 1 / nearer;
  nearest_ = {plane.per_column * nearer, plane.per_row * nearer,
              (plane.at_0 - depth_margin) * nearer - off.at(0)};
  farthest_ = {plane.per_column * farther, plane.per_row * farther,
               (plane.at_0 + depth_margin) * farther + off.at(0)};
}

void Outline::cut_before(const std::array<double, 2>& front) {
  if (least_ > front[1]) return;
  sides_[side_count_++] = {farthest_, front[0], -kInfinity};
  sides_[side_count_++] = {nearest_, -kInfinity, front[1]};
  if (greatest_ < front[0]) rows_.end = rows_.first;
  least_ = std::max(least_, front[0]);
}

Outline::Row Outline::row(int row) const {
  const int count = columns_.end - columns_.first, y = row - rows_.first;
  struct {
    double low, high;
  } possible = {0, count - 1.0}, sure = possible;
  for (std::size_t i = 0; i < side_count_; ++i) {
    const Side& side = sides_[i];
    const double at_0 = side.inside.in_row(y), per_column = side.inside.per_column;
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
          nearest_.in_row(y), farthest_.in_row(y)};
}

}  // namespace pipeline
