#include "libpipeline/picture/shading.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "libpipeline/numbers/vec_math.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "libpipeline/picture/shading.cpp"
#include "libpipeline/picture/light_lanes.h"

PIPELINE_BEGIN_KERNELS();

static_assert(kLanes <= kMaxLanesShaded);

// Doubles miss a half by far less than this, so that halves go up.
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

/// Those of the corners in x, y, z, for kLanes pixels from the `first` of the run; L3.
HWY_INLINE Vectors corner_weights(const PixelRun& run, int first) {
  const auto& [a, b, c] = run.weights.scaled();
  const Doubles x = all(run.grid.left_x) + hn::Iota(kDoubles, run.column + first) * all(run.grid.dx);
  const Doubles y = all(run.grid.y_of(run.row)), zero = hn::Zero(kDoubles);
  // The corners, from a pixel's center, times their w; and twice the areas that two of them make with it.
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

const KernelTable<RunShader>& run_shaders() {
  static constexpr KernelTable<RunShader> kKernels = PIPELINE_KERNEL_TABLE(shade);
  return kKernels;
}

RunShader run_shader() {
  static const RunShader chosen = chosen_kernel(run_shaders());
  return chosen;
}

}  // namespace pipeline

#endif
