#include "tools/zbuf/surface_shading.h"

#include <cmath>
#include <string>
#include <utility>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/picture/image_formats.h"
#include "libpipeline/text/error.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

Lighting lighting_of(const Appearance& appearance, bool is_perspective) {
  Lighting lighting;
  if (appearance.ambient) lighting.ambient = appearance.ambient->value;
  if (appearance.attenuation) lighting.attenuation = appearance.attenuation->value;
  for (const auto& light : appearance.lights) lighting.lights.push_back(light.value);
  lighting.is_perspective = is_perspective;
  return lighting;
}

std::vector<Material> materials_of(const Appearance& appearance) {
  std::vector<Material> materials;
  for (const auto& material : appearance.materials) materials.push_back(material.value);
  if (materials.empty()) materials.emplace_back();
  return materials;
}

void add_material_colors(const Appearance& appearance, TriangleBatch& batch) {
  AttributeArrays& attributes = batch.attributes;
  attributes.colors.clear();
  const auto color_of = [&](std::size_t material) {
    return appearance.materials[material].value.paint.value_or(Vec3{255, 255, 255});
  };
  for (Sphere& sphere : batch.spheres) sphere.color = color_of(sphere.material);
  for (std::size_t i = 0; i < batch.size(); ++i) {
    const Vec3 color = color_of(attributes.materials.empty() ? 0 : attributes.materials[i]);
    attributes.colors.push_back({color, color, color});
    if (batch.unclipped_of(i) == nullptr) continue;
    ClipTriangle whole = *batch.unclipped_of(i);
    for (VertexLine& corner : whole) corner.color = color;
    batch.unclipped[i] = std::make_shared<ClipTriangle>(whole);
  }
}

ShadingModel shading_model(const Appearance& appearance, std::optional<ShadingModel> chosen) {
  if (chosen) return *chosen;
  if (appearance.lights.empty()) return ShadingModel::none;
  return appearance.columns().normal ? ShadingModel::phong : ShadingModel::flat;
}

Color background_color(const Appearance& appearance, std::optional<Color> chosen) {
  if (chosen) return *chosen;
  if (!appearance.background) return {};
  const auto& [color, alpha] = appearance.background->value;
  return rounded_color(color).with_alpha(static_cast<std::uint8_t>(std::floor(alpha + 0.5)));
}

std::string refused_background(Color background) {
  return expected_but_found(
      std::string("an opaque background, or -o FILE.png: no other image can be transparent") +
          (can_write_png() ? "" : " (and this build is without libpng, which .png needs)"),
      "an alpha of " + std::to_string(background.alpha()));
}

std::optional<SurfaceShader> surface_shader(const StageHeader& header, const SourceLocation& header_end,
                                            const Viewport& screen, const PictureOptions& chosen,
                                            bool is_wireframe) {
  const Appearance& appearance = header.appearance;
  SurfaceShader::Setup setup;
  setup.model = shading_model(appearance, chosen.shading);
  setup.background = background_color(appearance, parse_color(chosen.background));
  if (!setup.background.is_opaque() && !can_hold_alpha(chosen.image_path))
    throw InputError(appearance.background ? appearance.background->location : header_end,
                     refused_background(setup.background));
  if (setup.model == ShadingModel::none) {
    if (!appearance.columns().color && !appearance.is_painted() && !is_wireframe) return std::nullopt;
    return SurfaceShader(screen, std::move(setup));
  }
  if (appearance.lights.empty())
    throw InputError(header_end, "a light for --shading (a header line light)", "none");
  const ProjectionTransform projection = clip_from_view(*header.projected);
  setup.view_from_clip.emplace(projection);
  setup.lighting = lighting_of(appearance, projection.is_perspective);
  setup.materials = materials_of(appearance);
  return SurfaceShader(screen, std::move(setup));
}

}  // namespace pipeline
