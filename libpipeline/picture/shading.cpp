#include "libpipeline/picture/shading.h"

#include <algorithm>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

Vec3 turned_towards(const Vec3& direction, const Vec3& v) {
  return dot(v, direction) < 0 ? scaled(v, -1) : v;
}

/// A factor of 0 weakens nothing, not even at a distance that overflows a double.
double attenuation_at(double distance, const Attenuation& a) {
  double weakening = a.constant;
  if (a.linear != 0) weakening += a.linear * distance;
  if (a.quadratic != 0) weakening += a.quadratic * distance * distance;
  return 1 / weakening;
}

double clamped_channel(double value) {
  return std::clamp(value, 0.0, 255.0);
}

// What doubles miss of a half is far less than this, so that halves go up.
constexpr double kHalf = 0.5 + 0x1p-20;

// L6
std::uint8_t rounded_channel(double value) {
  return static_cast<std::uint8_t>(clamped_channel(value) + kHalf);  // rounds down
}

/// `arriving(light)` is the part of a light's intensity that reaches the point.
template <typename Arriving>
Vec3 lit_color_of(const SurfacePoint& point, const Lighting& lighting, const Material& material,
                  const Vec3& to_eye, const Arriving& arriving) {
  const Vec3 normal = turned_towards(to_eye, unit_vector(point.normal));
  Vec3 diffuse = scaled(lighting.ambient, material.ambient);
  Vec3 specular;
  for (const Light& light : lighting.lights) {
    const Vec3 way = difference(light.position, point.position);
    const Vec3 to_light = unit_vector(way);
    const double cosine = dot(normal, to_light);
    if (!(cosine > 0)) continue;
    const Vec3 intensity = scaled(arriving(light), attenuation_at(dot(way, to_light), lighting.attenuation));
    diffuse = sum(diffuse, scaled(intensity, material.diffuse * cosine));
    const Vec3 half = unit_vector(sum(to_light, to_eye));
    const double highlight = whole_power(std::max(0.0, dot(normal, half)), material.shininess);
    specular = sum(specular, scaled(intensity, material.specular * highlight));
  }
  return sum(product(point.color, diffuse), scaled(specular, 255));
}

}  // namespace

double whole_power(double base, std::uint64_t exponent) {
  double power = 1;
  for (; exponent != 0; exponent >>= 1) {
    if ((exponent & 1) != 0) power *= base;
    base *= base;
  }
  return power;
}

// L5
Vec3 lit_color(const SurfacePoint& point, const Lighting& lighting, const Material& material) {
  const Vec3 to_eye = lighting.is_perspective ? unit_vector(scaled(point.position, -1)) : Vec3{0, 0, 1};
  return lit_color_of(point, lighting, material, to_eye, [](const Light& light) { return light.intensity; });
}

Vec3 lit_color(const SurfacePoint& point, const Lighting& lighting, const Material& material,
               const Vec3& to_eye, const LightPart& part) {
  return lit_color_of(point, lighting, material, to_eye, [&](const Light& light) {
    return product(light.intensity, part(static_cast<std::size_t>(&light - lighting.lights.data())));
  });
}

Vec3 clamped_color(const Vec3& color) {
  return {clamped_channel(color.x), clamped_channel(color.y), clamped_channel(color.z)};
}

Color rounded_color(const Vec3& color) {
  return {rounded_channel(color.x), rounded_channel(color.y), rounded_channel(color.z)};
}

}  // namespace pipeline
