#include "libpipeline/raytracing/surface_triangle.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/numbers/vec_math.h"

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

/// By the distance of the start from the plane, times the normal's length: calculating it costs less than
/// 2^-48 of the product of the three lengths.
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

}  // namespace pipeline
