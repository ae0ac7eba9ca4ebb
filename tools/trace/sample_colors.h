#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/raytracing/light_transport.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/appearance.h"
#include "libpipeline/scene/color.h"
#include "tools/trace/trace_options.h"
#include "tools/trace/trace_work.h"
#include "tools/trace/traced_scene.h"

namespace pipeline {

/// Gives samples their colors, for one thread. A sample is a pixel of the screen whose rays are cast: of the
/// picture's, or of a finer one.
class SampleColors {
 public:
  SampleColors() = default;
  virtual ~SampleColors() = default;
  SampleColors(const SampleColors&) = delete;
  SampleColors& operator=(const SampleColors&) = delete;

  /// The color of a sample that shows `seen`; one that shows nothing has the background's.
  virtual Color color(int row, int column, const RayCaster::Seen& seen) = 0;
  /// Adds what was seen to that of the other threads, when all are done.
  virtual void add_up() const = 0;
};

/// The colors of `zbuf`: without shadows, mirrors and glass.
class SurfaceColors final : public SampleColors {
 public:
  /// Without a shader, every triangle has a color of its own.
  SurfaceColors(const TracedScene& scene, SurfaceShader* shader);

  Color color(int row, int column, const RayCaster::Seen& seen) override;
  void add_up() const override {
    if (shader_ != nullptr) shader_->add_shown(shown_);
  }

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
  SurfaceShader* shader_;
  ExactProjection projection_;
  TriangleColors own_colors_;
  TriangleBatch p_view_;
  std::vector<CachedSurface> cache_;
  ShownColors shown_;
};

/// The setup for a scene of this appearance, restricted by the options.
LightTransportSetup light_transport_setup(const Appearance& appearance, bool is_perspective,
                                          const TraceOptions& chosen);

/// Whether the setup needs rays beyond primary ones: a shadow may fall, or a material mirrors or is clear.
bool needs_light_transport(const LightTransportSetup& setup);

/// The colors of pixels, or of samples, by the light that rays bring from what they see.
class LightColors final : public SampleColors {
 public:
  /// For the pixels of `rays`, on a background that may be transparent. Rays are counted in `work`.
  LightColors(const LightTransport& transport, const PixelRays& rays, Color background, TraceWork& work,
              ShownLight& all_shown)
      : light_(transport), rays_(rays), background_(background), work_(work), all_shown_(all_shown) {}

  /// Clamped and rounded as `zbuf` does.
  Color color(int row, int column, const RayCaster::Seen& seen) override {
    const Color color = rounded_color(light_.radiance(seen.id, rays_.ray(row, column)));
    colors_.add_pixel(color, background_);
    return color;
  }
  void add_up() const override {
    work_.rays.add(light_.counts());
    all_shown_.add(light_.shown());
    all_shown_.shows_something |= colors_.show_something;
  }

 private:
  LightTransport::Thread light_;
  PixelRays rays_;
  Color background_;
  ShownColors colors_;
  TraceWork& work_;
  ShownLight& all_shown_;
};

}  // namespace pipeline
