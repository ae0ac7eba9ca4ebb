#include "tools/trace/sphere_report.h"

#include <cmath>
#include <limits>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

/// The reach of the surface c + u a + v b + w d, u^2 + v^2 + w^2 = 1, from c along a vector.
double reach(const SpherePoints& points, const Vec3& along) {
  double square = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double part = dot(difference(points[i], points[0]), along);
    square += part * part;
  }
  return std::sqrt(square);
}

/// The z of view space at a depth in NDC; minus infinity if no point in front of the eye has that depth.
double z_at(double depth, const ProjectionTransform& projection) {
  const auto [near, far] = std::pair(projection.near, projection.far);
  if (!projection.is_perspective) return -(near + (far - near) * ((depth + 1) / 2));
  const double part = (far + near) - depth * (far - near);
  return part > 0 ? -2 * near * (far / part) : -std::numeric_limits<double>::infinity();
}

UnseenPlace place_of(const SpherePoints& points, const BoundingBox& extent, const UnseenSpheres& spheres,
                     const ProjectionTransform& projection, const Viewport& screen) {
  if (projection.is_perspective && extent.low.z >= 0) return UnseenPlace::behind;
  if (extent.low.z > spheres.front) return UnseenPlace::near;
  if (extent.high.z <= spheres.rear) return UnseenPlace::far;
  // x in NDC is (x x_scale + z x_offset) / -z, or x x_scale + x_offset; `sign` is 1 if the inside is above
  // the limit.
  const auto is_outside = [&](const Vec3& axis, double offset, double limit, double sign) {
    const Vec3 along = projection.is_perspective ? sum(axis, {0, 0, offset + limit}) : axis;
    const double constant = projection.is_perspective ? 0 : sign * (offset - limit);
    return dot(points[0], scaled(along, sign)) + constant + reach(points, along) < 0;
  };
  const Vec3 x = {projection.x_scale.nearest_double(), 0, 0}, y = {0, projection.y_scale.nearest_double(), 0};
  const double x_offset = projection.x_offset.nearest_double(),
               y_offset = projection.y_offset.nearest_double();
  if (is_outside(x, x_offset, screen.left, 1)) return UnseenPlace::left;
  if (is_outside(x, x_offset, -screen.left, -1)) return UnseenPlace::right;
  if (is_outside(y, y_offset, screen.bottom, 1)) return UnseenPlace::below;
  return is_outside(y, y_offset, -screen.bottom, -1) ? UnseenPlace::above : UnseenPlace::elsewhere;
}

}  // namespace

void add_places(const TriangleBatch& p_view, const ProjectionTransform& projection, const Viewport& screen,
                UnseenSpheres& spheres) {
  spheres.front = z_at(screen.front, projection);
  spheres.rear = z_at(screen.rear, projection);
  spheres.front_is_near = screen.front == -1;
  spheres.rear_is_far = screen.rear == 1;
  for (const Sphere& sphere : p_view.spheres) {
    const double half = reach(sphere.points, {0, 0, 1});
    BoundingBox extent;
    extent.low.z = sphere.points[0].z - half;
    extent.high.z = sphere.points[0].z + half;
    spheres.places.add(place_of(sphere.points, extent, spheres, projection, screen), extent);
  }
}

}  // namespace pipeline
