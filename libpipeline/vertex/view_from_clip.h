#pragma once

#include "libpipeline/numbers/vec.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// Takes points of clip space back to view space: the inverse of a projection, in doubles.
class ViewFromClip {
 public:
  explicit ViewFromClip(const ProjectionTransform& projection);

  [[nodiscard]] bool is_perspective() const { return is_perspective_; }
  /// The w of clip space of a point, from its depth: its distance in front of the eye, or 1 if orthographic.
  [[nodiscard]] double w_of(const Vec3& p_ndc) const;
  /// The point in view space; it may lie behind the eye.
  [[nodiscard]] Vec3 operator()(const Vec3& p_clip, double w) const;

 private:
  bool is_perspective_;
  double x_scale_, x_offset_, y_scale_, y_offset_, near_, far_;
};

}  // namespace pipeline
