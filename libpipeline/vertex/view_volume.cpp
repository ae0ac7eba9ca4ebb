#include "libpipeline/vertex/view_volume.h"

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "libpipeline/vertex/projection.h"

namespace pipeline {

ViewVolume::ViewVolume(const ProjectionTransform& projection, double clip_inset)
    : projection_(projection),
      clip_inset_(clip_inset),
      coefficients_(coefficients_of(projection, clip_inset)) {}

std::optional<UnseenPlace> ViewVolume::outside(const Triangle& p_view) const {
  if (projection_.is_perspective &&
      std::all_of(p_view.begin(), p_view.end(), [](const Vec3& p) { return p.z >= 0; }))
    return UnseenPlace::behind;
  const CertainSides sides = certain_sides(coefficients_, p_view);
  if (sides.some_unsure == 0) return std::nullopt;
  if (const int first = std::countr_zero(sides.none_inside);
      first < 6 && (sides.all_outside >> first & 1u) != 0)
    return kAllClipPlanes[static_cast<std::size_t>(first)];
  std::vector<ClipVertex> polygon;
  unsigned any = 0, all = ~0u;
  for (const Vec3& p : p_view) {
    const unsigned code = outcode(polygon.emplace_back(to_clip_space(projection_, p, clip_inset_)));
    any |= code;
    all &= code;
  }
  if (any == 0) return std::nullopt;
  if (all != 0) return kAllClipPlanes[static_cast<std::size_t>(std::countr_zero(all))];
  for (const ClipPlane plane : kAllClipPlanes) {
    polygon = clip_polygon(polygon, std::span(&plane, 1));
    if (polygon.empty()) return plane;
  }
  return std::nullopt;
}

}  // namespace pipeline
