#include "libpipeline/vertex/clip.h"

#include <algorithm>
#include <bit>

#include "libpipeline/numbers/exact_sum.h"

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

std::size_t index_of(ClipPlane plane) {
  return static_cast<std::size_t>(plane) - static_cast<std::size_t>(kAllClipPlanes[0]);
}

/// The axis of a plane: 0 for z, 1 for x, 2 for y.
std::size_t axis_of(ClipPlane plane) {
  return index_of(plane) / 2;
}

/// True if a plane bounds its axis below.
bool is_low(ClipPlane plane) {
  return index_of(plane) % 2 == 0;
}

Ball distance_by_coordinates(ClipPlane plane, const ClipVertex& vertex) {
  constexpr std::array kCoordinates = {&ClipVertex::z, &ClipVertex::x, &ClipVertex::y};
  const Ball& coordinate = vertex.*kCoordinates[axis_of(plane)];
  return is_low(plane) ? vertex.w + coordinate : vertex.w - coordinate;
}

/// The distance from unrounded products; none if it depends on a tangent that is not a double.
std::optional<Ball> exact_distance(ClipPlane plane, const ClipVertex::Origin& vertex) {
  const ProjectionTransform* const projection = vertex.projection;
  const Vec3& p = vertex.p_view;
  const int sign = is_low(plane) ? -1 : 1;
  const double w = projection->is_perspective ? -p.z : 1, inset = vertex.clip_inset;
  // From the plane where at * coordinate = scale * low (or high).
  const auto distance = [&](double low, double high, double scale, double at, double coordinate) {
    return exact_sum({{2.0 * sign, scale, sign < 0 ? low : high},
                      {-2.0 * sign, at, coordinate},
                      {-inset, w, high},
                      {inset, w, low}}) /
           (Ball(high) - low);
  };
  const std::size_t axis = axis_of(plane);
  const double near = projection->near, far = projection->far;
  const double other = !projection->is_perspective ? 1 : sign < 0 ? far : near;
  if (axis == 0) return distance(near, far, other, other, -p.z);
  const auto& sides = projection->sides[axis - 1];
  if (!sides) return std::nullopt;
  return distance(sides->low, sides->high, w, sides->at, axis == 1 ? p.x : p.y);
}

/// The distance with a certain sign, if possible, where `distance`, from the coordinates, leaves it open.
Ball distance_with_sign(ClipPlane plane, const ClipVertex& vertex, const Ball& distance) {
  if (vertex.origin.projection == nullptr || distance.is_exact()) return distance;
  return exact_distance(plane, vertex.origin).value_or(distance);
}

// P9
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
  // One of the distances is negative.
  const int farther = compare(from.sign() < 0 ? -from : from, to.sign() < 0 ? -to : to);
  if (farther > 0 || (farther == 0 && is_lower(b, a))) return cut(plane, b, a);
  return interpolate(a, b, from / (from - to));
}

// P8
std::vector<ClipVertex> clip_at(ClipPlane plane, std::span<const ClipVertex> polygon) {
  std::vector<ClipVertex> inside;
  std::size_t strictly_inside_count = 0;
  const int first_side = side_of(plane, polygon.front());
  int here_side = first_side;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipVertex& here = polygon[i];
    const ClipVertex& next = polygon[(i + 1) % polygon.size()];
    const int next_side = i + 1 < polygon.size() ? side_of(plane, next) : first_side;
    if (here_side >= 0) inside.push_back(here);
    if (here_side > 0) ++strictly_inside_count;
    if (here_side * next_side < 0) inside.push_back(cut(plane, here, next));
    here_side = next_side;
  }
  // A polygon that touches the plane from outside has no area inside; one that lies in the plane is kept.
  if (strictly_inside_count == 0 && inside.size() < polygon.size()) inside.clear();
  return inside;
}

}  // namespace

ClipVertex to_clip_space(const ProjectionTransform& projection, const Vec3& p_view, double clip_inset) {
  const Ball distance = -p_view.z;
  const Ball near = projection.near;
  const Ball far = projection.far;
  ClipVertex vertex;
  vertex.x = projection.x_scale * p_view.x;
  vertex.y = projection.y_scale * p_view.y;
  if (projection.is_perspective) {
    vertex.x = vertex.x + projection.x_offset * p_view.z;
    vertex.y = vertex.y + projection.y_offset * p_view.z;
    vertex.z = ((distance - near) * far - (far - distance) * near) / (far - near);
    vertex.w = distance;
  } else {
    vertex.x = vertex.x + projection.x_offset;
    vertex.y = vertex.y + projection.y_offset;
    vertex.z = (distance + distance - (near + far)) / (far - near);
    vertex.w = 1;
  }
  if (clip_inset != 0) vertex.w = vertex.w * (Ball(1) - clip_inset);
  vertex.origin = {&projection, p_view, clip_inset};
  return vertex;
}

// P6
Ball distance_inside(ClipPlane plane, const ClipVertex& vertex) {
  const Ball distance = distance_by_coordinates(plane, vertex);
  return distance.sign() != 0 ? distance : distance_with_sign(plane, vertex, distance);
}

int side_of(ClipPlane plane, const ClipVertex& vertex) {
  const Ball distance = distance_by_coordinates(plane, vertex);
  const int sign = distance.sign();
  return sign != 0 ? sign : distance_with_sign(plane, vertex, distance).sign();
}

unsigned outcode(const ClipVertex& vertex) {
  unsigned code = 0;
  for (std::size_t i = 0; i < kAllClipPlanes.size(); ++i)
    if (side_of(kAllClipPlanes[i], vertex) < 0) code |= 1u << i;
  return code;
}

Outcodes outcodes(std::span<const ClipVertex> polygon) {
  Outcodes codes;
  for (const ClipVertex& vertex : polygon) {
    const unsigned code = outcode(vertex);
    codes.any |= code;
    codes.all &= code;
  }
  return codes;
}

std::vector<ClipVertex> clip_polygon(std::span<const ClipVertex> polygon, std::span<const ClipPlane> planes) {
  std::vector<ClipVertex> inside(polygon.begin(), polygon.end());
  for (const ClipPlane plane : planes) {
    if (inside.empty()) break;
    inside = clip_at(plane, inside);
  }
  return inside;
}

ViewVolume::ViewVolume(const ProjectionTransform& projection, double clip_inset)
    : projection_(projection),
      clip_inset_(clip_inset),
      coefficients_(coefficients_of(projection, clip_inset)) {}

std::optional<UnseenPlace> ViewVolume::outside(const Triangle& p_view) const {
  if (projection_.is_perspective &&
      std::all_of(p_view.begin(), p_view.end(), [](const Vec3& p) { return p.z >= 0; }))
    return UnseenPlace::behind;
  const CertainSides sides = certain_sides(coefficients_, p_view);
  if (sides.some_unsure == 0) return std::nullopt;
  if (const int first = std::countr_zero(sides.none_inside);
      first < 6 && (sides.all_outside >> first & 1u) != 0)
    return kAllClipPlanes[static_cast<std::size_t>(first)];
  std::vector<ClipVertex> polygon;
  for (const Vec3& p : p_view) polygon.push_back(to_clip_space(projection_, p, clip_inset_));
  const auto [any, all] = outcodes(polygon);
  if (any == 0) return std::nullopt;
  if (all != 0) return kAllClipPlanes[static_cast<std::size_t>(std::countr_zero(all))];
  for (const ClipPlane plane : kAllClipPlanes) {
    polygon = clip_polygon(polygon, std::span(&plane, 1));
    if (polygon.empty()) return plane;
  }
  return std::nullopt;
}

}  // namespace pipeline
