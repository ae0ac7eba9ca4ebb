#include "tools/trace/sample_colors.h"

#include <algorithm>

#include "tools/zbuf/surface_shading.h"

namespace pipeline {

SurfaceColors::SurfaceColors(const TracedScene& scene, SurfaceShader* shader)
    : triangles_(scene.triangles()),
      shader_(shader),
      projection_(scene.projection(), "", scene.header().projected.has_value()),
      cache_(kCached) {}

const SurfaceColors::CachedSurface& SurfaceColors::surface(Id id) {
  CachedSurface& cached = cache_[id % kCached];
  if (cached.id == id) return cached;
  cached.id = id;
  cached.own_color = own_colors_.of(triangles_.number(id));
  if (shader_ == nullptr) return cached;
  p_view_.clear();
  triangles_.copy(id, p_view_);
  const TriangleBatch& p_ndc = projection_.project(p_view_);
  const std::size_t piece = triangles_.piece(id).value_or(0);
  if (!p_ndc.attributes.colors.empty()) shown_.add_triangle(p_ndc.attributes.colors[piece]);
  cached.surface = shader_->surface_of(p_ndc, piece, cached.own_color);
  return cached;
}

Color SurfaceColors::color(int row, int column, const RayCaster::Seen& seen) {
  const CachedSurface& shown = surface(seen.id);
  if (shader_ == nullptr) return shown.own_color;
  const Color color = shader_->color_at(shown.surface, row, column);
  shown_.add_pixel(color, shader_->setup().background);
  return color;
}

LightTransportSetup light_transport_setup(const Appearance& appearance, bool is_perspective,
                                          const TraceOptions& chosen) {
  const Color background = background_color(appearance, parse_color(chosen.background));
  LightTransportSetup setup;
  setup.model = shading_model(appearance, chosen.shading);
  setup.lighting = lighting_of(appearance, is_perspective);
  setup.materials = materials_of(appearance);
  setup.background = to_vec3(background);
  setup.has_shadows = !chosen.without_shadows;
  setup.recurses = !chosen.without_recursion;
  setup.min_contribution = chosen.min_contribution;
  setup.max_depth = chosen.max_depth;
  return setup;
}

bool needs_light_transport(const LightTransportSetup& setup) {
  const bool has_lights = setup.model != ShadingModel::none && !setup.lighting.lights.empty();
  return (has_lights && setup.has_shadows) ||
         (setup.recurses && std::ranges::any_of(setup.materials, &Material::sends_rays));
}

}  // namespace pipeline
