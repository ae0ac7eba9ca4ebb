#pragma once

#include <array>
#include <optional>

#include "libpipeline/scene/camera.h"
#include "libpipeline/vertex/affine_matrix.h"

namespace pipeline {

// The matrices of OpenGL's glRotate, gluLookAt, gluPerspective, glFrustum and glOrtho. Each entry is a ball
// that contains the exact entry for the given doubles.

/// The rotation by `angle_degrees` about an axis of any length but 0, counterclockwise when the axis points
/// at the observer. By Rodrigues' formula in vector form, for each column.
AffineMatrix rotation(double angle_degrees, const Vec3& axis);

/// The transform from world to view space: p_view = rows * (p_world - eye). The rows right, up and backward
/// are orthonormal. The eye is kept separate: subtracting it from a point first keeps the digits of points
/// far from the origin.
struct ViewTransform {
  Vec3 eye;
  BallVec3 right;
  BallVec3 up;
  BallVec3 backward;
};

/// The view transform of a camera. `look` must differ from `eye`, and `up` must not be parallel to the view
/// direction (check_camera).
ViewTransform view_from_world(const Vec3& eye, const Vec3& look, const Vec3& up);

/// The sides of the view volume on an axis, not rounded: `low` and `high` at the distance `at` in front of
/// the eye; for an orthographic projection at every distance.
struct VolumeSides {
  double at = 1;
  double low = 0;
  double high = 0;
};

/// From view to clip space. With d = -z the distance in front of the eye:
///   perspective:   x_clip = x_scale x + x_offset z,  w = d
///   orthographic:  x_clip = x_scale x + x_offset,    w = 1
/// likewise y; z / w runs from -1 at d = near to 1 at d = far.
struct ProjectionTransform {
  bool is_perspective = true;
  Ball x_scale, x_offset;
  Ball y_scale, y_offset;
  double near = 0;
  double far = 0;
  /// The sides in x and y; none where a tangent is not a double.
  std::array<std::optional<VolumeSides>, 2> sides = {};
};

/// The projection as scales and offsets. An InputError at `projection.location` if fovX, by the rule `angle`,
/// is not in (0, 180) degrees.
ProjectionTransform clip_from_view(const Located<Projection>& projection);

/// The projection's view volume, which needs no aspect rule: a perspective as the Frustum of `transform`,
/// which must come from `projection`; others unchanged. An InputError at `projection.location` if a plane is
/// beyond a double's range.
Projection volume_of(const Located<Projection>& projection, const ProjectionTransform& transform);

/// The inverse of a projection, from clip to view space, in doubles.
class ViewFromClip {
 public:
  explicit ViewFromClip(const ProjectionTransform& clip_from_view);

  /// A point's w in clip space from its depth in NDC: the distance in front of the eye, or 1 if orthographic.
  [[nodiscard]] double w_of(const Vec3& p_ndc) const;
  /// The point in view space, which may lie behind the eye.
  [[nodiscard]] Vec3 operator()(const Vec3& p_clip, double w) const;

 private:
  bool is_perspective_;
  double x_scale_, x_offset_, y_scale_, y_offset_, near_, far_;
};

}  // namespace pipeline
