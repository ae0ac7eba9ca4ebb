#include "tools/trace/sample_colors.h"

namespace pipeline {

SampleColors::SampleColors(const TracedScene& scene, const Bvh& bvh, const PixelRays& rays,
                           const ColorSetup& setup)
    : triangles_(scene.triangles()), rays_(rays), setup_(setup), cache_(kCached) {
  if (setup.light != nullptr) light_.emplace(triangles_, bvh, *setup.light);
}

const SampleColors::CachedSurface& SampleColors::surface(Id id) {
  CachedSurface& cached = cache_[id % kCached];
  if (cached.id == id) return cached;
  cached.id = id;
  cached.own_color = own_colors_.of(triangles_.number(id));
  if (setup_.shader == nullptr) return cached;
  const TriangleBatch& p_ndc = triangles_.p_ndc();
  if (!p_ndc.attributes.colors.empty()) shown_.add_triangle(p_ndc.attributes.colors[id]);
  cached.surface = setup_.shader->surface_of(p_ndc, id, cached.own_color);
  return cached;
}

/// Rays' colors are clamped and rounded as `zbuf` does.
Color SampleColors::color(int row, int column, const RayCaster::Seen& seen) {
  Color color;
  if (light_) {
    color = rounded_color(light_->radiance(seen.id, rays_.ray(row, column)));
  } else {
    const CachedSurface& shown = surface(seen.id);
    if (setup_.shader == nullptr) return shown.own_color;
    color = setup_.shader->color_at(shown.surface, row, column);
  }
  shown_.add_pixel(color, setup_.background);
  return color;
}

}  // namespace pipeline
