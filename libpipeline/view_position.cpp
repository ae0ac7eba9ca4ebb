#include "libpipeline/view_position.h"

namespace pipeline {

ViewFromNdc::ViewFromNdc(const ProjectionTransform& projection)
    : is_perspective_(projection.is_perspective),
      x_scale_(projection.x_scale.nearest_double()),
      x_offset_(projection.x_offset.nearest_double()),
      y_scale_(projection.y_scale.nearest_double()),
      y_offset_(projection.y_offset.nearest_double()),
      near_(projection.near),
      far_(projection.far) {}

/// The depth of a perspective is ((d - n) f - (f - d) n) / (d (f - n)), solved for d.
double ViewFromNdc::w_of(const Vec3& p_ndc) const {
  if (!is_perspective_) return 1;
  return 2 * far_ * near_ / (far_ * (1 - p_ndc.z) + near_ * (1 + p_ndc.z));
}

Vec3 ViewFromNdc::operator()(const Vec3& p_ndc, double w) const {
  if (is_perspective_)
    return {(p_ndc.x + x_offset_) * w / x_scale_, (p_ndc.y + y_offset_) * w / y_scale_, -w};
  const double distance = (far_ * (1 + p_ndc.z) + near_ * (1 - p_ndc.z)) / 2;
  return {(p_ndc.x - x_offset_) / x_scale_, (p_ndc.y - y_offset_) / y_scale_, -distance};
}

}  // namespace pipeline
