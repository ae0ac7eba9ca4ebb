#include "tools/trace/light_colors.h"

#include <algorithm>

#include "tools/zbuf/surface_shading.h"

namespace pipeline {

LightTransportSetup light_transport_setup(const Appearance& appearance, bool is_perspective,
                                          const TraceOptions& chosen) {
  const Color background = background_color(appearance, parse_color(chosen.picture.background));
  LightTransportSetup setup;
  setup.model = shading_model(appearance, chosen.picture.shading);
  setup.lighting = lighting_of(appearance, is_perspective);
  setup.materials = materials_of(appearance);
  setup.background = {static_cast<double>(background.red()), static_cast<double>(background.green()),
                      static_cast<double>(background.blue())};
  setup.has_shadows = !chosen.without_shadows;
  setup.recurses = !chosen.without_recursion;
  setup.min_contribution = chosen.min_contribution;
  setup.max_depth = chosen.max_depth;
  return setup;
}

bool needs_light_transport(const LightTransportSetup& setup) {
  const bool has_lights = setup.model != ShadingModel::none && !setup.lighting.lights.empty();
  const auto sends_rays = [](const Material& material) { return material.sends_rays(); };
  return (has_lights && setup.has_shadows) ||
         (setup.recurses && std::ranges::any_of(setup.materials, sends_rays));
}

}  // namespace pipeline
