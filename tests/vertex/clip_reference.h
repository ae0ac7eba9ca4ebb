#pragma once

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "libpipeline/vertex/clip.h"
#include "tests/numbers/real.h"

namespace pipeline {

using Exact = Real<448>;
using Polygon = std::vector<ClipVertex>;
using Coordinate = Ball ClipVertex::*;

constexpr Coordinate kCoordinates[] = {&ClipVertex::x, &ClipVertex::y, &ClipVertex::z, &ClipVertex::w};

// The allowed error of a cut, relative to the polygon's size.
inline const Exact kTolerance = times_power_of_two(Exact(1), -85);

inline bool is_same(const ClipVertex& a, const ClipVertex& b) {
  return std::all_of(std::begin(kCoordinates), std::end(kCoordinates),
                     [&](Coordinate c) { return a.*c == b.*c; });
}

inline Exact value(const Ball& ball) {
  return midpoint<448>(ball);
}

/// Twice the signed area of a polygon's projection onto the plane of two coordinates.
inline Exact double_area(const Polygon& polygon, Coordinate first, Coordinate second) {
  Exact sum;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex& a = polygon[i];
    const ClipVertex& b = polygon[(i + 1) % polygon.size()];
    sum = sum + value(a.*first) * value(b.*second) - value(b.*first) * value(a.*second);
  }
  return sum;
}

/// The largest coordinate.
inline Exact size_of(const Polygon& polygon) {
  Exact size;
  for (const ClipVertex& v : polygon)
    for (const Coordinate c : kCoordinates) size = std::max(size, abs(value(v.*c)));
  return size;
}

/// Exchanges the inside and the outside of every plane.
inline Polygon turned_inside_out(Polygon polygon) {
  for (ClipVertex& v : polygon)
    for (const Coordinate c : kCoordinates) v.*c = -(v.*c);
  return polygon;
}

inline Polygon clipped_at(ClipPlane plane, const Polygon& polygon) {
  return clip_polygon(polygon, std::array{plane});
}

inline bool is_same(const Polygon& a, const Polygon& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& p, const auto& q) { return is_same(p, q); });
}

}  // namespace pipeline
