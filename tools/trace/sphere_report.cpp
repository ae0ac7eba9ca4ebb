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

}  // namespace

SphereReport::SphereReport(const ProjectionTransform& projection, const Viewport& screen)
    : is_perspective_(projection.is_perspective) {
  spheres_.front = z_at(screen.front, projection);
  spheres_.rear = z_at(screen.rear, projection);
  spheres_.front_is_near = screen.front == -1;
  spheres_.rear_is_far = screen.rear == 1;
  const double x_scale = projection.x_scale.nearest_double(), y_scale = projection.y_scale.nearest_double();
  const double x_offset = projection.x_offset.nearest_double(),
               y_offset = projection.y_offset.nearest_double();
  // x in NDC is (x x_scale + z x_offset) / -z, or x x_scale + x_offset; `sign` is 1 if the inside is above
  // the limit.
  const auto plane = [&](const Vec3& axis, double offset, double limit, double sign, UnseenPlace outside) {
    if (is_perspective_) return Plane{scaled(sum(axis, {0, 0, offset + limit}), sign), 0, outside};
    return Plane{scaled(axis, sign), sign * (offset - limit), outside};
  };
  planes_ = {plane({x_scale, 0, 0}, x_offset, screen.left, 1, UnseenPlace::left),
             plane({x_scale, 0, 0}, x_offset, -screen.left, -1, UnseenPlace::right),
             plane({0, y_scale, 0}, y_offset, screen.bottom, 1, UnseenPlace::below),
             plane({0, y_scale, 0}, y_offset, -screen.bottom, -1, UnseenPlace::above)};
}

void SphereReport::add(const TriangleBatch& p_view) {
  for (const Sphere& sphere : p_view.spheres) {
    const SpherePoints& points = sphere.points;
    const double half = reach(points, {0, 0, 1});
    const double low = points[0].z - half, high = points[0].z + half;
    BoundingBox extent;
    extent.low.z = low;
    extent.high.z = high;
    spheres_.places.add(place_of(points, low, high), extent);
  }
}

UnseenPlace SphereReport::place_of(const SpherePoints& points, double low, double high) const {
  if (is_perspective_ && low >= 0) return UnseenPlace::behind;
  if (low > spheres_.front) return UnseenPlace::near;
  if (high <= spheres_.rear) return UnseenPlace::far;
  for (const Plane& plane : planes_)
    if (dot(points[0], plane.factors) + plane.offset + reach(points, plane.factors) < 0) return plane.outside;
  return UnseenPlace::elsewhere;
}

}  // namespace pipeline
