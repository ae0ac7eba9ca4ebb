#include "libpipeline/vertex/clip.h"

#include <utility>

namespace pipeline {
namespace {

/// -1, 0 or 1: a's midpoint is below, at or above b's.
int compare(const Ball& a, const Ball& b) {
  const double difference = (a - b).value().hi;
  return difference < 0 ? -1 : (difference > 0 ? 1 : 0);
}

/// Orders by y, x and z, then by w, so that only equal points tie.
bool is_lower(const ClipVertex& a, const ClipVertex& b) {
  if (const int y = compare(a.y, b.y); y != 0) return y < 0;
  if (const int x = compare(a.x, b.x); x != 0) return x < 0;
  if (const int z = compare(a.z, b.z); z != 0) return z < 0;
  return compare(a.w, b.w) < 0;
}

ClipVertex interpolate(const ClipVertex& a, const ClipVertex& b, const Ball& t) {
  const auto between = [&](const Ball& from, const Ball& to) { return from + t * (to - from); };
  const double share = t.nearest_double();
  const auto weight = [&](std::size_t i) { return (1 - share) * a.weights[i] + share * b.weights[i]; };
  return {between(a.x, b.x),
          between(a.y, b.y),
          between(a.z, b.z),
          between(a.w, b.w),
          {weight(0), weight(1), weight(2)}};
}

/// The intersection of a plane with the edge between two vertices on different sides, interpolated from the
/// vertex nearer to the plane: the other may be so large that its last digits hide the cut.
ClipVertex cut(ClipPlane plane, const ClipVertex& a, const ClipVertex& b) {
  const Ball from = distance_inside(plane, a);
  const Ball to = distance_inside(plane, b);
  // One of them is negative.
  const int farther = compare(from.sign() < 0 ? -from : from, to.sign() < 0 ? -to : to);
  if (farther > 0 || (farther == 0 && is_lower(b, a))) return cut(plane, b, a);
  return interpolate(a, b, from / (from - to));
}

std::vector<ClipVertex> clip_at(ClipPlane plane, std::span<const ClipVertex> polygon) {
  std::vector<ClipVertex> inside;
  std::size_t strictly_inside_count = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex& here = polygon[i];
    const ClipVertex& next = polygon[(i + 1) % polygon.size()];
    const int here_side = distance_inside(plane, here).sign();
    const int next_side = distance_inside(plane, next).sign();
    if (here_side >= 0) inside.push_back(here);
    if (here_side > 0) ++strictly_inside_count;
    if (here_side * next_side < 0) inside.push_back(cut(plane, here, next));
  }
  // A polygon that touches the plane from outside has no area inside; one that lies in the plane is kept.
  if (strictly_inside_count == 0 && inside.size() < polygon.size()) inside.clear();
  return inside;
}

}  // namespace

ClipVertex to_clip_space(const ProjectionTransform& projection, const Vec3& p_view) {
  const Ball distance = -p_view.z;
  const Ball near = projection.near;
  const Ball far = projection.far;
  const Ball x = projection.x_scale * p_view.x;
  const Ball y = projection.y_scale * p_view.y;
  if (!projection.is_perspective) {
    const Ball z = (distance + distance - (near + far)) / (far - near);
    return {x + projection.x_offset, y + projection.y_offset, z, 1};
  }
  const Ball z = ((distance - near) * far - (far - distance) * near) / (far - near);
  return {x + projection.x_offset * p_view.z, y + projection.y_offset * p_view.z, z, distance};
}

Ball distance_inside(ClipPlane plane, const ClipVertex& vertex) {
  switch (plane) {
    case ClipPlane::near:
      return vertex.w + vertex.z;
    case ClipPlane::far:
      return vertex.w - vertex.z;
    case ClipPlane::left:
      return vertex.w + vertex.x;
    case ClipPlane::right:
      return vertex.w - vertex.x;
    case ClipPlane::bottom:
      return vertex.w + vertex.y;
    case ClipPlane::top:
      break;
  }
  return vertex.w - vertex.y;
}

unsigned outcode(const ClipVertex& vertex) {
  unsigned code = 0;
  for (std::size_t i = 0; i < kAllClipPlanes.size(); ++i)
    if (distance_inside(kAllClipPlanes[i], vertex).sign() < 0) code |= 1u << i;
  return code;
}

std::vector<ClipVertex> clip_polygon(std::span<const ClipVertex> polygon, std::span<const ClipPlane> planes) {
  std::vector<ClipVertex> inside(polygon.begin(), polygon.end());
  for (const ClipPlane plane : planes) {
    if (inside.empty()) break;
    inside = clip_at(plane, inside);
  }
  return inside;
}

}  // namespace pipeline
