#include "tools/surface_shading.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "libpipeline/text/error.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {
namespace {

/// How surfaces are lit, by the number of their material; without a line, the one material is the default.
std::vector<Lighting> lightings_of(const Appearance& appearance, bool is_perspective) {
  Lighting lighting;
  if (appearance.ambient) lighting.ambient = appearance.ambient->value;
  if (appearance.attenuation) lighting.attenuation = appearance.attenuation->value;
  for (const auto& light : appearance.lights) lighting.lights.push_back(light.value);
  lighting.is_perspective = is_perspective;
  std::vector<Lighting> lightings(std::max<std::size_t>(appearance.materials.size(), 1), lighting);
  for (std::size_t i = 0; i < appearance.materials.size(); ++i)
    lightings[i].material = appearance.materials[i].value;
  return lightings;
}

ShadingModel default_model(const Appearance& appearance) {
  if (appearance.lights.empty()) return ShadingModel::none;
  return appearance.columns().normal ? ShadingModel::phong : ShadingModel::flat;
}

}  // namespace

Color background_color(const Appearance& appearance, std::optional<Color> chosen) {
  if (chosen) return *chosen;
  return appearance.background ? rounded_color(appearance.background->value) : Color();
}

std::optional<SurfaceShader> surface_shader(const StageHeader& header, const SourceLocation& header_end,
                                            const Viewport& screen, const SurfaceOptions& chosen) {
  const Appearance& appearance = header.appearance;
  SurfaceShader::Setup setup;
  setup.model = chosen.model.value_or(default_model(appearance));
  setup.background = background_color(appearance, chosen.background);
  setup.says_what_was_clipped = !appearance.lights.empty();
  if (chosen.wireframe) setup.wireframe.emplace(*chosen.wireframe);
  if (setup.model == ShadingModel::none) {
    if (!appearance.columns().color && !chosen.wireframe) return std::nullopt;
    return SurfaceShader(screen, std::move(setup));
  }
  if (appearance.lights.empty())
    throw InputError(header_end, expected_but_found("a light for --shading (a header line light)", "none"));
  const ProjectionTransform projection = clip_from_view(*header.projected);
  setup.view_from_clip.emplace(projection);
  setup.lightings = lightings_of(appearance, projection.is_perspective);
  return SurfaceShader(screen, std::move(setup));
}

}  // namespace pipeline
