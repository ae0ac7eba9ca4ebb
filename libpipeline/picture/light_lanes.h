// No include guard: included once for each target, see numbers/vector_targets.h.

#include <bit>
#include <cstdint>

#include "libpipeline/numbers/lanes.h"
#include "libpipeline/picture/shading.h"

PIPELINE_BEGIN_KERNELS();

// The light formula, for as many points at a time as a vector has doubles.

/// -1 below 0, else 1.
HWY_INLINE Doubles side_of(Doubles value) {
  return hn::IfThenElse(hn::Lt(value, hn::Zero(kDoubles)), all(-1), all(1));
}

HWY_INLINE Vectors to_eye_from(const Vectors& position, const Lighting& lighting) {
  if (!lighting.is_perspective) return all(Vec3{0, 0, 1});
  const Vectors to_eye = unit(position * all(-1));
  const auto has_direction = hn::Eq(to_eye.x, to_eye.x);
  return {hn::IfThenElseZero(has_direction, to_eye.x), hn::IfThenElseZero(has_direction, to_eye.y),
          hn::IfThenElseZero(has_direction, to_eye.z)};
}

/// A factor of 0 weakens nothing, not even at a distance that overflows a double.
HWY_INLINE Doubles weakening_at(Doubles distance, const Attenuation& a) {
  Doubles weakening = all(a.constant);
  if (a.linear != 0) weakening = weakening + all(a.linear) * distance;
  if (a.quadratic != 0) weakening = weakening + all(a.quadratic) * distance * distance;
  return weakening;
}

/// By repeated squaring, so that it does not depend on the system's library; 1 to the power 0.
HWY_INLINE Doubles whole_power(Doubles base, std::uint64_t exponent) {
  if (exponent == 0) return all(1);
  for (int i = std::countr_zero(exponent); i > 0; --i) base = base * base;
  Doubles power = base;
  for (exponent >>= std::countr_zero(exponent); (exponent >>= 1) != 0;) {
    base = base * base;
    if ((exponent & 1) != 0) power = power * base;
  }
  return power;
}

struct PointLanes {
  Vectors position;
  Vectors normal;
  Vectors color;
};

/// `arriving(light)` is the part of a light's intensity that reaches the points; called only for lights in
/// front of one.
template <typename Arriving>
HWY_INLINE Vectors lit(const PointLanes& points, const Lighting& lighting, const Material& material,
                       const Vectors& to_eye, const Arriving& arriving) {
  const Vectors given = unit(points.normal), normal = given * side_of(dot(given, to_eye));
  Vectors diffuse = all(lighting.ambient) * all(material.ambient);
  Vectors specular = all(Vec3());
  const Attenuation& fading = lighting.attenuation;
  const bool fades = fading.linear != 0 || fading.quadratic != 0, is_shiny = material.specular != 0;
  const Doubles unfaded = all(1 / fading.constant);
  for (const Light& light : lighting.lights) {
    const Vectors way = all(light.position) - points.position;
    const Vectors to_light = unit(way);
    const Doubles cosine = dot(normal, to_light);
    const auto is_in_front = hn::Gt(cosine, hn::Zero(kDoubles));
    if (hn::AllFalse(kDoubles, is_in_front)) continue;
    const Doubles strength = fades ? all(1) / weakening_at(dot(way, to_light), fading) : unfaded;
    const Vectors intensity = all(arriving(light)) * hn::IfThenElseZero(is_in_front, strength);
    diffuse = diffuse + intensity * (all(material.diffuse) * hn::IfThenElseZero(is_in_front, cosine));
    if (!is_shiny) continue;
    const Doubles toward_half = dot(normal, unit(to_light + to_eye));
    const Doubles base = hn::IfThenElseZero(hn::Gt(toward_half, hn::Zero(kDoubles)), toward_half);
    specular = specular + intensity * (all(material.specular) * whole_power(base, material.shininess));
  }
  return points.color * diffuse + specular * all(255);
}

PIPELINE_END_KERNELS();
