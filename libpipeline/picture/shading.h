#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/picture/corner_weights.h"
#include "libpipeline/scene/appearance.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The points where a surface is lit: none, one per triangle, its vertices, or every pixel.
enum class ShadingModel { none, flat, gouraud, phong };

/// The lights of a scene, in view space: the eye is the origin and looks down -z.
struct Lighting {
  Vec3 ambient;
  Attenuation attenuation;
  std::vector<Light> lights;
  bool is_perspective = true;  // otherwise the eye is infinitely far away in the direction +z
};

/// A point of a surface, in view space, its normal (of any length) and its own color, channels from 0 to
/// 255.
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;
  Vec3 color;
};

/// The color that the eye sees on a surface of this material, with channels not yet rounded or clamped:
///   color (ka ambient + sum att L kd n.l) + 255 ks sum att L max(0, n.h)^shininess
/// with both sums over the lights in front of the surface, n.l > 0, as in OpenGL. n is the normal turned
/// toward the eye, l the direction of a light, h halfway between l and the eye's direction. A normal of 0
/// faces no light, and a light at the point itself does not light it. Source: J. Blinn, "Models of light
/// reflection for computer synthesized pictures", 1977.
Vec3 lit_color(const SurfacePoint& point, const Lighting& lighting, const Material& material = {});

/// The part of light number `light` that reaches a surface: red, green, blue, each from 0 to 1.
using LightPart = std::function<Vec3(std::size_t light)>;

/// lit_color as seen from the direction `to_eye`, of length 1, with a part of each light. `part` is called
/// only for lights in front of the surface.
Vec3 lit_color(const SurfacePoint& point, const Lighting& lighting, const Material& material,
               const Vec3& to_eye, const LightPart& part);

/// The color with each channel clamped to 0 to 255.
Vec3 clamped_color(const Vec3& color);

/// Each channel clamped to 0 to 255 and rounded; halves, or up to 2^-20 below, go up.
Color rounded_color(const Vec3& color);

/// Neighboring pixels of a row that show the same triangle. The corners' colors are interpolated,
/// perspective-correctly; with a material, all attributes are, and each pixel is lit.
struct PixelRun {
  const CornerWeights& weights;
  const std::array<SurfacePoint, 3>& corners;
  const Material* material;
  const PixelGrid& grid;
  int row;
  int column;  // of the first pixel
  int count;
};

/// The maximum number of pixels that a kernel shades at a time.
constexpr std::size_t kMaxLanesShaded = 8;

/// Writes the colors of a run's pixels, and up to kMaxLanesShaded - 1 more. All kernels write the same.
using RunShader = void (*)(const PixelRun& run, const Lighting& lighting, Color* colors);

extern const KernelTable<RunShader> kRunShaders;

/// The kernel in use.
RunShader run_shader();

}  // namespace pipeline
