#pragma once

#include "libpipeline/transform.h"
#include "libpipeline/vec.h"

namespace pipeline {

/// Takes projected points back to view space: the inverse of a projection and its divide, in doubles.
class ViewFromNdc {
 public:
  explicit ViewFromNdc(const ProjectionTransform& projection);

  [[nodiscard]] bool is_perspective() const { return is_perspective_; }
  /// The w of clip space of a point, from its depth: its distance in front of the eye, or 1 if orthographic.
  [[nodiscard]] double w_of(const Vec3& p_ndc) const;
  /// The point in view space, given its w.
  [[nodiscard]] Vec3 operator()(const Vec3& p_ndc, double w) const;

 private:
  bool is_perspective_;
  double x_scale_, x_offset_, y_scale_, y_offset_, near_, far_;
};

}  // namespace pipeline
