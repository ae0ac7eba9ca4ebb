#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The image of a sphere under an affine map: the points c + u a + v b + w d with u^2 + v^2 + w^2 = 1, where
/// c is the center and a, b, d are the half axes, which need not be perpendicular.
/// A ray is mapped to the space of u, v and w, where the surface is the unit sphere, and the quadratic
/// equation for the distance is solved in pairs of doubles: in doubles, f.f - 1 cancels for a ray that
/// begins, at f in that space, near the surface of a large sphere, and the distance has a relative error of
/// 3e-9 at a radius of 1e8. Here, the error is within 2^-50 for rays that begin within 2^40 radii of the
/// center, unless they graze the surface.
class Ellipsoid {
 public:
  /// The ellipsoid of these points; none if they lie in a plane, as far as pairs of doubles can tell.
  static std::optional<Ellipsoid> from(const SpherePoints& points);

  /// The t of a ray where its line enters the ellipsoid, and where it leaves it; NaN where it does neither.
  using Meetings = std::array<double, 2>;
  /// The meetings of a ray's line with the surface. A ray that begins on the surface, up to rounding, has one
  /// at most: its exit on the other side, if it goes inward.
  [[nodiscard]] Meetings meetings(const Ray& ray, bool begins_on_surface = false) const;

  /// The outward normal, of length 1, at a point of the surface.
  [[nodiscard]] Vec3 normal(const Vec3& point) const;
  /// The box around it, up to rounding by 2^-50 of the largest coordinate of its SpherePoints.
  [[nodiscard]] BoundingBox box() const;

 private:
  using Row = std::array<DoubleDouble, 3>;

  /// A ray in the space of the unit sphere.
  struct UnitRay {
    Row origin, direction;
  };

  explicit Ellipsoid(const SpherePoints& points) : center_(points[0]) {}

  [[nodiscard]] bool is_surely_missed(const Ray& ray) const;
  [[nodiscard]] UnitRay in_unit_space(const Ray& ray) const;

  Vec3 center_;
  Vec3 extent_;              // half of the box
  std::array<Row, 3> rows_;  // of the inverse of the matrix with the columns a, b, d
};

}  // namespace pipeline
