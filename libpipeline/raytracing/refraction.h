#pragma once

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

/// The mirror image of a ray in `direction` that meets a surface with `normal` on its side, both of length 1.
inline Vec3 mirrored(const Vec3& direction, const Vec3& normal) {
  return sum(direction, scaled(normal, -2 * dot(direction, normal)));
}

/// The refracted direction by Snell's law; `ratio` as above. None if all light is reflected.
inline std::optional<Vec3> refracted(const Vec3& direction, const Vec3& normal, double ratio) {
  if (ratio == 1) return direction;
  const double cosine = -dot(direction, normal);
  const double square = 1 - ratio * ratio * (1 - cosine * cosine);
  if (!(square > 0)) return std::nullopt;
  return unit_vector(sum(scaled(direction, ratio), scaled(normal, ratio * cosine - std::sqrt(square))));
}

/// e to the power -x for x >= 0, the same on every system to the last bit: 1 for 0, and 0 if it is too small
/// for a double. The whole multiples of log 2 in x become a power of two; the rest r, |r| <= 0.35, goes into
/// the first 14 terms of the series, whose sum is off by less than 2^-52 (the next term is below 0.35^14 /
/// 14! < 2^-57). All in all, the relative error is below 2^-50.
inline double decay(double x) {
  if (!(x < 745.2)) return 0;
  // log 2 in two parts; the first has so few digits that its products with whole numbers are exact.
  constexpr double kLog2High = 0x1.62e42fefap-1, kLog2Low = 0x1.cf79abc9e3b3ap-40;
  const double whole = std::floor(x / 0x1.62e42fefa39efp-1 + 0.5);
  const double r = (whole * kLog2High - x) + whole * kLog2Low;
  double sum = 1;
  for (int n = 13; n >= 1; --n) sum = 1 + sum * r / n;
  return std::ldexp(sum, -static_cast<int>(whole));
}

}  // namespace pipeline
