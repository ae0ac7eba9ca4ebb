#pragma once

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/raytracing/light_transport.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/scene/appearance.h"
#include "libpipeline/scene/color.h"
#include "tools/trace/sample_colors.h"
#include "tools/trace/trace_options.h"
#include "tools/trace/trace_work.h"

namespace pipeline {

/// The setup for a scene of this appearance, restricted by the options.
LightTransportSetup light_transport_setup(const Appearance& appearance, bool is_perspective,
                                          const TraceOptions& chosen);

/// Whether the setup needs rays beyond primary ones: a shadow may fall, or a material mirrors or is clear.
bool needs_light_transport(const LightTransportSetup& setup);

/// The colors of pixels, or of samples, by the light that rays bring from what they see. One for each thread.
class LightColors : public SampleColors {
 public:
  /// For the pixels of `screen`, on a background that may be transparent.
  LightColors(const LightTransport& transport, const ProjectionTransform& projection, const Viewport& screen,
              Color background)
      : light_(transport), rays_(projection, screen), background_(background) {}

  /// Clamped and rounded as `zbuf` does.
  [[nodiscard]] Color color(int row, int column, const RayCaster::Seen& seen) override {
    const Color color = rounded_color(light_.radiance(seen.id, rays_.ray(row, column)));
    colors_.add_pixel(color, background_);
    return color;
  }
  [[nodiscard]] ShownLight shown() const {
    ShownLight shown = light_.shown();
    shown.shows_something = colors_.show_something;
    return shown;
  }
  void add_to(TraceWork& work) const { work.rays.add(light_.counts()); }

 private:
  LightTransport::Thread light_;
  PixelRays rays_;
  Color background_;
  ShownColors colors_;
};

}  // namespace pipeline
