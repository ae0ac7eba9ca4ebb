#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/numbers/vec_math.h"

namespace pipeline {

/// The part of unpolarized light that a smooth surface of clear matter mirrors, by Fresnel's equations: 1 if
/// all of it is reflected, beyond the critical angle. `ratio` is the refractive index on the side of the
/// light divided by the index on the other side, `cosine` the cosine of the angle between light and normal.
inline double fresnel_reflectance(double ratio, double cosine) {
  if (ratio == 1) return 0;
  const double square = 1 - ratio * ratio * (1 - cosine * cosine);  // of the refracted ray's cosine
  if (!(square > 0)) return 1;
  const double other = std::sqrt(square);
  const double across = (ratio * cosine - other) / (ratio * cosine + other);
  const double along = (ratio * other - cosine) / (ratio * other + cosine);
  return (across * across + along * along) / 2;
}

/// Of a ray in `direction` that meets a surface with `normal` on its side, both of length 1.
inline Vec3 mirrored(const Vec3& direction, const Vec3& normal) {
  return sum(direction, scaled(normal, -2 * dot(direction, normal)));
}

/// By Snell's law; `ratio` as above. None if all light is reflected.
inline std::optional<Vec3> refracted(const Vec3& direction, const Vec3& normal, double ratio) {
  if (ratio == 1) return direction;
  const double cosine = -dot(direction, normal);
  const double square = 1 - ratio * ratio * (1 - cosine * cosine);
  if (!(square > 0)) return std::nullopt;
  return unit_vector(sum(scaled(direction, ratio), scaled(normal, ratio * cosine - std::sqrt(square))));
}

}  // namespace pipeline
