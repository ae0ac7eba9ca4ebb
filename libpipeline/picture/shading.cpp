#include "libpipeline/picture/shading.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include "libpipeline/numbers/vec_math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/picture/shading.cpp"
#include "libpipeline/numbers/lanes.h"

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

/// The divisor at a distance. A factor of 0 has no effect, even at a distance that overflows a double.
HWY_INLINE Doubles weakening_at(Doubles distance, const Attenuation& a) {
  Doubles weakening = all(a.constant);
  if (a.linear != 0) weakening = weakening + all(a.linear) * distance;
  if (a.quadratic != 0) weakening = weakening + all(a.quadratic) * distance * distance;
  return weakening;
}

/// The power by repeated squaring, so that it does not depend on the system's library; 1 for exponent 0.
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

/// The color of lit points. `arriving(light)` is the intensity that reaches them; it is called only for
/// lights in front of at least one.
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

static_assert(kLanes <= kMaxLanesShaded);

// Halves go up: errors of doubles are far below 2^-20.
constexpr double kAlmostHalf = 0.5 + 0x1p-20;

// L6; NaN counts as 0
HWY_INLINE auto rounded(Doubles channel) {
  constexpr hn::Rebind<std::int32_t, decltype(kDoubles)> kInts;
  const Doubles clamped = hn::Min(hn::Max(channel, hn::Zero(kDoubles)), all(255));
  return hn::DemoteTo(kInts, clamped + all(kAlmostHalf));  // rounds down
}

/// Writes kLanes colors.
HWY_INLINE void store_rounded(const Vectors& color, Color* colors) {
  const auto red = rounded(color.x), green = rounded(color.y), blue = rounded(color.z);
  const auto packed = hn::Or(hn::ShiftLeft<16>(red), hn::Or(hn::ShiftLeft<8>(green), blue));
  std::array<std::int32_t, kLanes> rgb;
  hn::StoreU(packed, hn::DFromV<decltype(packed)>(), rgb.data());
  static_assert(sizeof(Color) == sizeof rgb[0]);
  std::memcpy(static_cast<void*>(colors), rgb.data(), sizeof rgb);
}

/// The weights of the corners, in x, y, z, for kLanes pixels from the run's pixel `first` on; L3.
HWY_INLINE Vectors corner_weights(const PixelRun& run, int first) {
  const auto& [a, b, c] = run.weights.scaled();
  const Doubles x = all(run.grid.left_x) + hn::Iota(kDoubles, run.column + first) * all(run.grid.dx);
  const Doubles y = all(run.grid.y_of(run.row)), zero = hn::Zero(kDoubles);
  // The corners relative to a pixel's center, times their w; then twice the areas of center and two corners.
  const Vectors w = all(Vec3{a.z, b.z, c.z});
  const Vectors right = all(Vec3{a.x, b.x, c.x}) - w * x, up = all(Vec3{a.y, b.y, c.y}) - w * y;
  const Vectors areas = {right.y * up.z - up.y * right.z, right.z * up.x - up.z * right.x,
                         right.x * up.y - up.x * right.y};
  const Doubles sum = areas.x + areas.y + areas.z;
  const Vectors turned = areas * side_of(sum);
  const Vectors inside = {hn::Max(turned.x, zero), hn::Max(turned.y, zero), hn::Max(turned.z, zero)};
  Vectors weights = inside / (inside.x + inside.y + inside.z);
  const auto is_certain = hn::Gt(hn::Abs(sum) * all(0x1p16), all(run.weights.doubt()));
  if (HWY_LIKELY(hn::AllTrue(kDoubles, is_certain))) return weights;
  const Doubles certain = hn::IfThenElseZero(is_certain, all(1));
  for (std::size_t lane = 0; lane < kLanes && first + static_cast<int>(lane) < run.count; ++lane) {
    if (hn::ExtractLane(certain, lane) != 0) continue;
    const auto exact = run.weights.exactly_at(run.grid, run.row, run.column + first + static_cast<int>(lane));
    weights = {hn::InsertLane(weights.x, lane, exact[0]), hn::InsertLane(weights.y, lane, exact[1]),
               hn::InsertLane(weights.z, lane, exact[2])};
  }
  return weights;
}

HWY_INLINE Vectors mean(const Vec3& a, const Vec3& b, const Vec3& c, const Vectors& weights) {
  return all(a) * weights.x + all(b) * weights.y + all(c) * weights.z;
}

// L4a
void shade(const PixelRun& run, const Lighting& lighting, Color* colors) {
  const auto& [a, b, c] = run.corners;
  for (int i = 0; i < run.count; i += static_cast<int>(kLanes)) {
    const Vectors weights = corner_weights(run, i);
    const Vectors own = mean(a.color, b.color, c.color, weights);
    if (run.material == nullptr) {
      store_rounded(own, colors + i);
      continue;
    }
    const PointLanes points = {mean(a.position, b.position, c.position, weights),
                               mean(a.normal, b.normal, c.normal, weights), own};
    const auto intensity = [](const Light& light) { return light.intensity; };
    const Vectors to_eye = to_eye_from(points.position, lighting);
    store_rounded(lit(points, lighting, *run.material, to_eye, intensity), colors + i);
  }
}

PIPELINE_END_KERNELS();

#if HWY_ONCE

namespace pipeline {
namespace {

template <typename Arriving>
Vec3 lit_color_of(const SurfacePoint& point, const Lighting& lighting, const Material& material,
                  const N_SCALAR::Vectors& to_eye, const Arriving& arriving) {
  const auto& [position, normal, color] = point;
  const N_SCALAR::PointLanes points = {N_SCALAR::all(position), N_SCALAR::all(normal), N_SCALAR::all(color)};
  const N_SCALAR::Vectors seen = N_SCALAR::lit(points, lighting, material, to_eye, arriving);
  return {seen.x.raw, seen.y.raw, seen.z.raw};
}

}  // namespace

// L5
Vec3 lit_color(const SurfacePoint& point, const Lighting& lighting, const Material& material) {
  const N_SCALAR::Vectors to_eye = N_SCALAR::to_eye_from(N_SCALAR::all(point.position), lighting);
  return lit_color_of(point, lighting, material, to_eye, [](const Light& light) { return light.intensity; });
}

Vec3 lit_color(const SurfacePoint& point, const Lighting& lighting, const Material& material,
               const Vec3& to_eye, const LightPart& part) {
  return lit_color_of(point, lighting, material, N_SCALAR::all(to_eye), [&](const Light& light) {
    return product(light.intensity, part(static_cast<std::size_t>(&light - lighting.lights.data())));
  });
}

Vec3 clamped_color(const Vec3& color) {
  const auto clamped = [](double channel) { return std::clamp(channel, 0.0, 255.0); };
  return {clamped(color.x), clamped(color.y), clamped(color.z)};
}

Color rounded_color(const Vec3& color) {
  Color rounded;
  N_SCALAR::store_rounded(N_SCALAR::all(color), &rounded);
  return rounded;
}

constinit const KernelTable<RunShader> kRunShaders = PIPELINE_KERNEL_TABLE(shade);

RunShader run_shader() {
  static const RunShader chosen = chosen_kernel(kRunShaders);
  return chosen;
}

}  // namespace pipeline

#endif
