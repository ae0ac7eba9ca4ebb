#include "libpipeline/raytracing/surface_caster.h"

#include <algorithm>
#include <limits>

namespace pipeline {
namespace {

double coordinate(const Vec3& v, std::size_t axis) {
  return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

double size(const Vec3& v) {
  return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
}

std::size_t longest_axis(const Vec3& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  if (z >= x && z >= y) return 2;
  return x >= y ? 0 : 1;
}

}  // namespace

SurfaceTriangleTest::SurfaceTriangleTest(const SurfaceRay& ray)
    : ray_(ray),
      x_((longest_axis(ray.ray.direction) + 1) % 3),
      y_((x_ + 1) % 3),
      z_(longest_axis(ray.ray.direction)),
      z_scale_(1 / coordinate(ray.ray.direction, z_)) {
  x_shear_ = coordinate(ray.ray.direction, x_) * z_scale_;
  y_shear_ = coordinate(ray.ray.direction, y_) * z_scale_;
}

SurfaceTriangleTest::Edges SurfaceTriangleTest::edges(const Triangle& p_view) const {
  std::array<double, 3> x, y, z;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 p = difference(p_view[i], ray_.ray.origin);
    z[i] = coordinate(p, z_);
    x[i] = coordinate(p, x_) - x_shear_ * z[i];
    y[i] = coordinate(p, y_) - y_shear_ * z[i];
  }
  return {{x[1] * y[2] - y[1] * x[2], x[2] * y[0] - y[2] * x[0], x[0] * y[1] - y[0] * x[1]}, z};
}

SurfaceMeeting SurfaceTriangleTest::meeting(const Edges& edges) const {
  auto [w, z] = edges;
  const double side = w[0] + w[1] + w[2] < 0 ? -1 : 1;
  for (double& weight : w) weight = std::max(side * weight, 0.0);
  const double sum = w[0] + w[1] + w[2];
  if (!(sum > 0)) return {z[0] * z_scale_, {1, 0, 0}};
  for (double& weight : w) weight /= sum;
  return {mean(z, w) * z_scale_, w};
}

std::optional<SurfaceMeeting> SurfaceTriangleTest::operator()(const Triangle& p_view) const {
  const Edges e = edges(p_view);
  const auto& [a, b, c] = e.functions;
  const bool may_be_front = a >= 0 && b >= 0 && c >= 0;
  const bool may_be_back = a <= 0 && b <= 0 && c <= 0;
  if (may_be_front == may_be_back) return std::nullopt;  // missed, or seen edge-on
  const SurfaceMeeting found = meeting(e);
  if (!(found.t > 0) || may_start_on(p_view)) return std::nullopt;
  return found;
}

SurfaceMeeting SurfaceTriangleTest::known(const Triangle& p_view) const {
  return meeting(edges(p_view));
}

/// True if the start's distance from the plane may be within the error. The distance times the normal's
/// length has a rounding error below 2^-48 of the product of the three lengths.
bool SurfaceTriangleTest::may_start_on(const Triangle& p_view) const {
  if (ray_.start == kNoSurface) return false;
  const Vec3 a = difference(p_view[1], p_view[0]), b = difference(p_view[2], p_view[0]);
  const Vec3 start = difference(ray_.ray.origin, p_view[0]);
  const Vec3 normal = cross(a, b);
  const double bound = size(normal) * ray_.error + 0x1p-48 * size(a) * size(b) * size(start);
  return !(std::fabs(dot(normal, start)) > bound);
}

double error_of_mean(const Triangle& p_view) {
  double largest = 0;
  for (const Vec3& p : p_view) largest = std::max(largest, largest_in(p));
  return 0x1p-49 * largest;
}

SurfaceHit SurfaceCaster::nearest(const SurfaceRay& ray) {
  const SurfaceTriangleTest test(ray);
  SurfaceId nearest = kNoSurface;
  SurfaceMeeting with_nearest = {};
  double limit = std::numeric_limits<double>::infinity();
  bvh_.for_each_candidate(ray.ray, 0, limit, [&](SurfaceId id) {
    for_each_meeting(id, ray, test, [&](const SurfaceMeeting& meeting) {
      if (std::pair(meeting.t, id) >= std::pair(limit, nearest)) return;
      nearest = id;
      with_nearest = meeting;
      limit = meeting.t;
    });
  });
  return nearest == kNoSurface ? SurfaceHit() : hit(nearest, ray.ray, with_nearest);
}

SurfaceHit SurfaceCaster::seen(SurfaceId id, bool is_from_within, const Ray& ray) {
  if (!triangles_.is_sphere(id)) return hit(id, ray, SurfaceTriangleTest({ray}).known(triangles_.p_view(id)));
  const auto [entrance, exit] = triangles_.sphere(id).surface.meetings(ray);
  return hit(id, ray, {is_from_within ? exit : entrance, {}, !is_from_within});
}

SurfaceHit SurfaceCaster::hit(SurfaceId id, const Ray& ray, const SurfaceMeeting& meeting) {
  const auto& [t, weights, is_front] = meeting;
  const Vec3 normal = unit_normal(id, ray, t);
  const std::uint32_t material = triangles_.material(id);
  if (triangles_.is_sphere(id))
    return {.id = id,
            .t = t,
            .point = point_at(ray, t),
            .error = error_of_point(ray, t),
            .face_normal = normal,
            .normal = normal,
            .color = triangles_.sphere(id).color,
            .material = material,
            .is_front = is_front};
  const Triangle& p_view = triangles_.p_view(id);
  const auto* const normals = triangles_.normals(id);
  const auto* const colors = triangles_.colors(id);
  return {.id = id,
          .t = t,
          .point = mean(p_view, weights),
          .error = error_of_mean(p_view),
          .face_normal = normal,
          .normal = normals != nullptr ? mean(*normals, weights) : normal,
          .color = colors != nullptr ? mean(*colors, weights) : to_vec3(colors_.of(triangles_.number(id))),
          .material = material,
          .is_front = dot(ray.direction, normal) < 0,
          .weights = weights};
}

/// Neighbors meet a ray at the same point of their common edge, up to errors in t.
void SurfaceCaster::settle(std::vector<Crossing>& crossings) {
  constexpr double kSame = 0x1p-40;
  std::ranges::sort(crossings, {}, [](const Crossing& c) { return std::pair(c.t, c.id); });
  const auto is_same = [](const Crossing& a, const Crossing& b) {
    return a.material == b.material && a.is_front == b.is_front && b.t - a.t <= kSame * b.t;
  };
  crossings.erase(std::unique(crossings.begin(), crossings.end(), is_same), crossings.end());
}

std::optional<std::array<SurfacePoint, 3>> SurfaceCaster::corners(SurfaceId id) {
  if (triangles_.is_sphere(id)) return std::nullopt;
  const Triangle& p_view = triangles_.p_view(id);
  const Vec3 normal = unit_vector(face_normal(p_view));
  const auto* const normals = triangles_.normals(id);
  const auto* const colors = triangles_.colors(id);
  const Vec3 own = colors != nullptr ? Vec3() : to_vec3(colors_.of(triangles_.number(id)));
  std::array<SurfacePoint, 3> corners;
  for (std::size_t v = 0; v < 3; ++v)
    corners[v] = {p_view[v], normals != nullptr ? (*normals)[v] : normal,
                  colors != nullptr ? (*colors)[v] : own};
  return corners;
}

}  // namespace pipeline
