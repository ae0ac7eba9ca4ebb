#include "libpipeline/vertex/view_from_clip.h"

namespace pipeline {

ViewFromClip::ViewFromClip(const ProjectionTransform& projection)
    : is_perspective_(projection.is_perspective),
      x_scale_(projection.x_scale.nearest_double()),
      x_offset_(projection.x_offset.nearest_double()),
      y_scale_(projection.y_scale.nearest_double()),
      y_offset_(projection.y_offset.nearest_double()),
      near_(projection.near),
      far_(projection.far) {}

/// The depth of a perspective is ((d - n) f - (f - d) n) / (d (f - n)), solved for d.
double ViewFromClip::w_of(const Vec3& p_ndc) const {
  if (!is_perspective_) return 1;
  return 2 * far_ * near_ / (far_ * (1 - p_ndc.z) + near_ * (1 + p_ndc.z));
}

Vec3 ViewFromClip::operator()(const Vec3& p_clip, double w) const {
  if (is_perspective_)
    return {(p_clip.x + x_offset_ * w) / x_scale_, (p_clip.y + y_offset_ * w) / y_scale_, -w};
  const double distance = (far_ * (1 + p_clip.z) + near_ * (1 - p_clip.z)) / 2;
  return {(p_clip.x - x_offset_) / x_scale_, (p_clip.y - y_offset_) / y_scale_, -distance};
}

}  // namespace pipeline
