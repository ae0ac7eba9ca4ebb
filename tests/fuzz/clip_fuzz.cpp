// Clipping: the promises of clip_polygon, for triangles in clip space with coordinates of any size.

#include <algorithm>

#include "tests/fuzz/fuzz_bytes.h"
#include "tests/fuzz/require.h"
#include "tests/vertex/clip_reference.h"

namespace pipeline {
namespace {

ClipVertex taken_vertex(FuzzBytes& bytes) {
  const double x = bytes.number(), y = bytes.number(), z = bytes.number(), w = bytes.number();
  return {x, y, z, w};
}

void check_inside(const Polygon& triangle, const Polygon& inside) {
  require(inside.empty() || (inside.size() >= 3 && inside.size() <= 9),
          "six planes leave at most nine corners");
  const Exact least = -size_of(triangle) * kTolerance;
  for (const ClipVertex& v : inside)
    for (const ClipPlane plane : kAllClipPlanes)
      require(value(distance_inside(plane, v)) >= least, "no corner lies outside");
}

/// The projected areas of the parts inside and outside of a plane add up to the whole's; except that a
/// triangle in the plane is on both sides.
void check_area(const Polygon& triangle, ClipPlane plane) {
  const auto is_on_plane = [&](const ClipVertex& v) { return distance_inside(plane, v).sign() == 0; };
  if (std::all_of(triangle.begin(), triangle.end(), is_on_plane)) return;
  const Polygon inside = clipped_at(plane, triangle);
  const Polygon outside = clipped_at(plane, turned_inside_out(triangle));
  const Exact size = size_of(triangle);
  for (const Coordinate first : kCoordinates)
    for (const Coordinate second : kCoordinates) {
      const Exact sum = double_area(inside, first, second) + double_area(outside, first, second);
      require(abs(sum - double_area(triangle, first, second)) <= size * size * kTolerance,
              "area is conserved");
    }
}

/// A triangle that starts at another corner, or runs the other way round, is cut at the same points.
void check_same_corners(const Polygon& cut, const Polygon& other) {
  require(other.size() == cut.size(), "the order of the corners does not change how many are left");
  for (const ClipVertex& v : cut)
    require(std::any_of(other.begin(), other.end(), [&](const ClipVertex& w) { return is_same(v, w); }),
            "the order of the corners does not change where an edge is cut");
}

}  // namespace

void check(FuzzBytes bytes) {
  const ClipVertex a = taken_vertex(bytes), b = taken_vertex(bytes), c = taken_vertex(bytes);
  const Polygon triangle = {a, b, c};
  const Polygon inside = clip_polygon(triangle, kAllClipPlanes);
  check_inside(triangle, inside);
  const auto plane = kAllClipPlanes[static_cast<std::size_t>(bytes.whole(5))];
  check_area(triangle, plane);
  const Polygon cut = clipped_at(plane, triangle);
  check_same_corners(cut, clipped_at(plane, {b, c, a}));
  check_same_corners(cut, clipped_at(plane, {c, b, a}));
  const auto [any, all] = outcodes(triangle);
  if (all != 0) require(inside.empty(), "nothing is left of what lies outside of one plane");
  if (any == 0) require(is_same(inside, triangle), "what lies inside of all planes is unchanged");
}

}  // namespace pipeline
