#include "libpipeline/raytracing/surface_caster.h"

#include <algorithm>

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

/// A bound on the error, in each coordinate, of a ray's point at t on a sphere: the errors of t, of the
/// product and of the sum.
double error_of_point(const Ray& ray, double t) {
  return 0x1p-50 * (largest_in(ray.origin) + std::fabs(t) * largest_in(ray.direction));
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
  return {x[1] * y[2] - y[1] * x[2], x[2] * y[0] - y[2] * x[0], x[0] * y[1] - y[0] * x[1], z};
}

SurfaceTriangleTest::Meeting SurfaceTriangleTest::meeting(const Edges& edges) const {
  const double side = edges.a + edges.b + edges.c < 0 ? -1 : 1;
  std::array<double, 3> w = {std::max(side * edges.a, 0.0), std::max(side * edges.b, 0.0),
                             std::max(side * edges.c, 0.0)};
  const double sum = w[0] + w[1] + w[2];
  if (!(sum > 0)) return {edges.z[0] * z_scale_, {1, 0, 0}};
  for (double& weight : w) weight /= sum;
  return {(w[0] * edges.z[0] + w[1] * edges.z[1] + w[2] * edges.z[2]) * z_scale_, w};
}

std::optional<SurfaceTriangleTest::Meeting> SurfaceTriangleTest::operator()(const Triangle& p_view) const {
  const Edges e = edges(p_view);
  const bool may_be_front = e.a >= 0 && e.b >= 0 && e.c >= 0;
  const bool may_be_back = e.a <= 0 && e.b <= 0 && e.c <= 0;
  if (may_be_front == may_be_back) return std::nullopt;  // missed, or seen edge-on
  const Meeting found = meeting(e);
  if (!(found.t > 0) || may_start_on(p_view)) return std::nullopt;
  return found;
}

SurfaceTriangleTest::Meeting SurfaceTriangleTest::known(const Triangle& p_view) const {
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

/// A ray that starts on the sphere never meets it at its start, however near the other meeting is.
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
