#pragma once

#include "libpipeline/scene/camera.h"
#include "libpipeline/vertex/affine_matrix.h"

namespace pipeline {

// The matrices of OpenGL's glTranslate, glScale, glRotate, gluLookAt, gluPerspective, glFrustum and glOrtho.
// Each entry is within its stated error of exact arithmetic on the numbers as they were read.

AffineMatrix translation(const Vec3& offset);
AffineMatrix scaling(const Vec3& factors);
/// The rotation by `angle_degrees` about an axis of any length but 0, counter-clockwise when the axis points
/// at the observer. Column by column from Rodrigues' formula in vector form.
AffineMatrix rotation(double angle_degrees, const Vec3& axis);

/// From world to view space: p_view = rows * (p_world - eye). The rows are right, up and backward,
/// orthonormal. The eye is kept apart: subtracting it from a point first is what keeps the digits far from
/// the origin.
struct ViewTransform {
  Vec3 eye;
  BallVec3 right;
  BallVec3 up;
  BallVec3 backward;
};

/// The camera's view transform; eye and look differ, up is not parallel to the view direction.
ViewTransform view_from_world(const Vec3& eye, const Vec3& look, const Vec3& up);

/// How `--aspect` makes the horizontal field of view: the course's fovX = fovY * aspect, or gluPerspective's
/// tan(fovX / 2) = tan(fovY / 2) * aspect.
enum class AspectRule { angle, ratio };

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
};

/// The camera's projection. An InputError at `projection.location` if fovX is not within (0, 180) degrees.
ProjectionTransform clip_from_view(const Located<Projection>& projection, AspectRule aspect_rule);

/// The projection with the aspect rule already in it: a perspective as the frustum that `transform`, made of
/// it, is.
Projection volume_of(const Projection& projection, const ProjectionTransform& transform);

/// From clip to view space: the inverse of a projection, in doubles.
class ViewFromClip {
 public:
  explicit ViewFromClip(const ProjectionTransform& clip_from_view);

  [[nodiscard]] bool is_perspective() const { return is_perspective_; }
  /// A point's w in clip space, from its depth in NDC: its distance in front of the eye, 1 if orthographic.
  [[nodiscard]] double w_of(const Vec3& p_ndc) const;
  /// The point in view space; it may lie behind the eye.
  [[nodiscard]] Vec3 operator()(const Vec3& p_clip, double w) const;

 private:
  bool is_perspective_;
  double x_scale_, x_offset_, y_scale_, y_offset_, near_, far_;
};

}  // namespace pipeline
