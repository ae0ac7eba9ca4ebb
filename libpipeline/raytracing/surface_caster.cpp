#include "libpipeline/raytracing/surface_caster.h"

#include <algorithm>
#include <limits>

namespace pipeline {
namespace {

/// A bound on the error, in each coordinate, of the point of a sphere at t of a ray: the errors of t, of
/// its product and of the sum.
double error_of_point(const Ray& ray, double t) {
  return 0x1p-50 * (largest_in(ray.origin) + std::fabs(t) * largest_in(ray.direction));
}

}  // namespace

/// A ray that starts on the sphere itself leaves out that place as such, however near the other one is.
Ellipsoid::Meetings SurfaceCaster::sphere_meetings(SurfaceId id, const SurfaceRay& ray) const {
  const Ellipsoid& surface = triangles_.sphere(id).surface;
  const Ellipsoid::Meetings all =
      id == ray.start ? surface.meetings_from_surface(ray.ray) : surface.meetings(ray.ray);
  Ellipsoid::Meetings beyond;
  for (const Ellipsoid::Meeting& meeting : all) {
    const double way = meeting.t * largest_in(ray.ray.direction);
    const double error = ray.start == kNoSurface ? 0 : 2 * ray.error + error_of_point(ray.ray, meeting.t);
    if (way > error) beyond.list[beyond.count++] = meeting;
  }
  return beyond;
}

SurfaceHit SurfaceCaster::sphere_hit(SurfaceId id, const Ray& ray, const Ellipsoid::Meeting& meeting) {
  const TracedSphere& sphere = triangles_.sphere(id);
  const Vec3 point = point_at(ray, meeting.t);
  const Vec3 normal = sphere.surface.normal(point);
  return {.id = id,
          .t = meeting.t,
          .point = point,
          .error = error_of_point(ray, meeting.t),
          .face_normal = normal,
          .normal = normal,
          .color = sphere.color ? *sphere.color : to_vec3(colors_.of(sphere.number)),
          .material = sphere.material,
          .is_front = meeting.is_front};
}

std::optional<SurfaceHit> SurfaceCaster::nearest(const SurfaceRay& ray) {
  const SurfaceTriangleTest test(ray);
  SurfaceId nearest = kNoSurface;
  SurfaceTriangleTest::Meeting with_triangle{};
  Ellipsoid::Meeting with_sphere{};
  double limit = std::numeric_limits<double>::infinity();
  bvh_.for_each_candidate(ray.ray, 0, limit, [&](SurfaceId id) {
    const auto is_nearest = [&](double t) { return std::pair(t, id) < std::pair(limit, nearest); };
    if (triangles_.is_sphere(id)) {
      const Ellipsoid::Meetings found = sphere_meetings(id, ray);
      if (found.count == 0 || !is_nearest(found.list[0].t)) return;
      with_sphere = found.list[0];
      limit = with_sphere.t;
    } else {
      const auto found = meeting(id, ray, test);
      if (!found || !is_nearest(found->t)) return;
      with_triangle = *found;
      limit = with_triangle.t;
    }
    nearest = id;
  });
  if (nearest == kNoSurface) return std::nullopt;
  return triangles_.is_sphere(nearest) ? sphere_hit(nearest, ray.ray, with_sphere)
                                       : triangle_hit(nearest, ray.ray, with_triangle);
}

SurfaceHit SurfaceCaster::seen(SurfaceId id, const Ray& ray) {
  if (!triangles_.is_sphere(id))
    return triangle_hit(id, ray, SurfaceTriangleTest({ray}).known(triangles_.p_view(id)));
  const Ellipsoid::Meetings meetings = triangles_.sphere(id).surface.meetings(ray);
  const bool is_from_within = (id & TracedTriangles::kFromWithin) != 0;
  return sphere_hit(id & ~TracedTriangles::kFromWithin, ray, meetings.list[is_from_within ? 1 : 0]);
}

SurfaceHit SurfaceCaster::triangle_hit(SurfaceId id, const Ray& ray,
                                       const SurfaceTriangleTest::Meeting& meeting) {
  const Triangle& p_view = triangles_.p_view(id);
  const Vec3 normal = unit_vector(face_normal(p_view));
  const auto* const normals = triangles_.normals(id);
  const auto* const colors = triangles_.colors(id);
  return {.id = id,
          .t = meeting.t,
          .point = mean(p_view, meeting.weights),
          .error = error_of_mean(p_view),
          .face_normal = normal,
          .normal = normals != nullptr ? mean(*normals, meeting.weights) : normal,
          .color =
              colors != nullptr ? mean(*colors, meeting.weights) : to_vec3(colors_.of(triangles_.number(id))),
          .material = triangles_.material(id),
          .is_front = dot(ray.direction, normal) < 0,
          .weights = meeting.weights};
}

/// The neighbors at an edge meet a ray at the same point, up to errors in t.
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
