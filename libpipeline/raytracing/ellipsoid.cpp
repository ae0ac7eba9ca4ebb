#include "libpipeline/raytracing/ellipsoid.h"

#include <cmath>
#include <limits>

namespace pipeline {
namespace {

using Row = std::array<DoubleDouble, 3>;

Row difference_of(const Vec3& a, const Vec3& b) {
  return {two_sum(a.x, -b.x), two_sum(a.y, -b.y), two_sum(a.z, -b.z)};
}

DoubleDouble dot(const Row& a, const Row& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Row cross(const Row& a, const Row& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Row scaled(const Row& row, double power_of_two) {
  const auto times = [&](const DoubleDouble& x) {
    return DoubleDouble{x.hi * power_of_two, x.lo * power_of_two};
  };
  return {times(row[0]), times(row[1]), times(row[2])};
}

}  // namespace

std::optional<Ellipsoid> Ellipsoid::from(const SpherePoints& points) {
  std::array<Row, 3> axes;
  Ellipsoid ellipsoid(points);
  // Half axes of about 1 keep the products within a double's range.
  std::array<double, 3> to_one;
  for (std::size_t i = 0; i < 3; ++i) {
    const Row axis = difference_of(points[i + 1], points[0]);
    const double largest = largest_in(Vec3{axis[0].hi, axis[1].hi, axis[2].hi});
    if (!(largest > 0 && std::isfinite(largest))) return std::nullopt;
    to_one[i] = std::scalbn(1, -std::ilogb(largest));
    axes[i] = scaled(axis, to_one[i]);
  }
  const std::array<Row, 3> cofactors = {cross(axes[1], axes[2]), cross(axes[2], axes[0]),
                                        cross(axes[0], axes[1])};
  const DoubleDouble determinant = dot(axes[0], cofactors[0]);
  // Each axis is shorter than 2 sqrt(3), so the products add up to less than 2^9.
  constexpr double kRoundedAway = 0x1p-90;
  if (!(std::fabs(determinant.hi) > kRoundedAway)) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const DoubleDouble entry = cofactors[i][j] / determinant;
      ellipsoid.rows_[i][j] = {entry.hi * to_one[i], entry.lo * to_one[i]};
      if (!std::isfinite(entry.hi * to_one[i])) return std::nullopt;
    }
  }
  const auto extent = [&](std::size_t coordinate) {
    const auto part = [&](std::size_t i) { return axes[i][coordinate].hi / to_one[i]; };
    return std::hypot(part(0), part(1), part(2));
  };
  ellipsoid.extent_ = {extent(0), extent(1), extent(2)};
  return ellipsoid;
}

/// True if, in doubles, the discriminant is negative by more than its error. In sums of absolute values, the
/// origin is at most `far` and the direction at most `wide`: coordinates are off by at most 2^-49 of these,
/// and the discriminant by 2^-44 of their products.
bool Ellipsoid::is_surely_missed(const Ray& ray) const {
  const Vec3 from_center = difference(ray.origin, center_);
  double ff = 0, fg = 0, gg = 0, far = 0, wide = 0;
  for (const Row& row : rows_) {
    const std::array<double, 3> f = {row[0].hi * from_center.x, row[1].hi * from_center.y,
                                     row[2].hi * from_center.z};
    const std::array<double, 3> g = {row[0].hi * ray.direction.x, row[1].hi * ray.direction.y,
                                     row[2].hi * ray.direction.z};
    const double f_sum = f[0] + f[1] + f[2], g_sum = g[0] + g[1] + g[2];
    ff += f_sum * f_sum;
    fg += f_sum * g_sum;
    gg += g_sum * g_sum;
    far += std::fabs(f[0]) + std::fabs(f[1]) + std::fabs(f[2]);
    wide += std::fabs(g[0]) + std::fabs(g[1]) + std::fabs(g[2]);
  }
  const double discriminant = fg * fg - gg * (ff - 1);
  return discriminant < -0x1p-44 * wide * wide * (far * far + 1);
}

Ellipsoid::UnitRay Ellipsoid::in_unit_space(const Ray& ray) const {
  const Row from_center = difference_of(ray.origin, center_);
  const Vec3& d = ray.direction;
  UnitRay unit;
  for (std::size_t i = 0; i < 3; ++i) {
    unit.origin[i] = dot(rows_[i], from_center);
    unit.direction[i] = rows_[i][0] * d.x + rows_[i][1] * d.y + rows_[i][2] * d.z;
  }
  return unit;
}

/// The larger root in size is (-f.g -+ root) / g.g without cancellation; the other is (f.f - 1) / (g.g times
/// the larger).
Ellipsoid::Meetings Ellipsoid::meetings(const Ray& ray, bool begins_on_surface) const {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  constexpr Meetings kNone = {kNaN, kNaN};
  if (!begins_on_surface && is_surely_missed(ray)) return kNone;
  const auto [f, g] = in_unit_space(ray);
  const DoubleDouble half = -dot(f, g);
  const bool is_forward = half.hi > 0;
  if (begins_on_surface && !is_forward) return kNone;
  const DoubleDouble beyond = dot(f, f) + DoubleDouble{-1};
  const DoubleDouble gg = dot(g, g);
  DoubleDouble discriminant = half * half - gg * beyond;
  // The start may be so far off that the line misses the surface: then it counts as touching.
  if (begins_on_surface && !(discriminant.hi > 0)) discriminant = {};
  if (!(discriminant.hi >= 0) || !(gg.hi > 0)) return kNone;
  const DoubleDouble root = sqrt(discriminant);
  const DoubleDouble sum = is_forward ? half + root : half - root;
  const double larger = (sum / gg).hi;
  const double smaller = sum.hi == 0 ? larger : (beyond / sum).hi;
  if (!std::isfinite(larger) || !std::isfinite(smaller)) return kNone;
  if (begins_on_surface) return {kNaN, larger};
  return is_forward ? Meetings{smaller, larger} : Meetings{larger, smaller};
}

Vec3 Ellipsoid::normal(const Vec3& point) const {
  const Row from_center = difference_of(point, center_);
  Vec3 gradient;
  for (const Row& row : rows_) {
    const double u = dot(row, from_center).hi;
    gradient = sum(gradient, pipeline::scaled({row[0].hi, row[1].hi, row[2].hi}, u));
  }
  return unit_vector(gradient);
}

BoundingBox Ellipsoid::box() const {
  BoundingBox box;
  box.low = difference(center_, extent_);
  box.high = sum(center_, extent_);
  return box;
}

}  // namespace pipeline
