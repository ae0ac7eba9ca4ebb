#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/raytracing/light_transport.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/color.h"
#include "tools/trace/traced_scene.h"

namespace pipeline {

/// How samples get their colors.
struct ColorSetup {
  Color background;
  const SurfaceShader* shader = nullptr;       // of zbuf; without one, every triangle has a color of its own
  const LightTransportSetup* light = nullptr;  // if set, rays bring the colors, and not the shader
};

/// Gives samples their colors, for one thread. A sample is a pixel of the screen whose rays are cast: of the
/// picture's, or of a finer one.
class SampleColors {
 public:
  SampleColors(const TracedScene& scene, const Bvh& bvh, const PixelRays& rays, const ColorSetup& setup);

  /// The color of a sample that shows `seen`; one that shows nothing has the background's.
  Color color(int row, int column, const RayCaster::Seen& seen);
  [[nodiscard]] const ShownColors& shown() const { return shown_; }
  /// None if no rays bring colors.
  [[nodiscard]] const std::optional<LightTransport>& light() const { return light_; }

 private:
  using Id = TracedTriangles::Id;

  // Neighboring samples show the same few triangles; 75 KiB.
  static constexpr std::size_t kCached = 256;
  struct CachedSurface {
    std::optional<Id> id;
    Color own_color;  // of triangles without a shader
    SurfaceShader::Surface surface;
  };

  const CachedSurface& surface(Id id);

  const TracedTriangles& triangles_;
  PixelRays rays_;
  ColorSetup setup_;
  std::optional<LightTransport> light_;
  TriangleColors own_colors_;
  std::vector<CachedSurface> cache_;
  ShownColors shown_;
};

}  // namespace pipeline
