#include "tools/trace/surface_colors.h"

namespace pipeline {

SurfaceColors::SurfaceColors(const TracedScene& scene, const SurfaceShader* shader)
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
  const Color color = shader_->color_at(shown.surface, shader_->grid().center(row, column));
  shown_.add_pixel(color, shader_->setup().background);
  return color;
}

}  // namespace pipeline
