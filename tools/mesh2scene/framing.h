#pragma once

#include <optional>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

enum class UpAxis { x, y, z };

/// Orthogonal unit vectors of a camera, in the model's space; `back` points from the model to the eye.
struct ViewAxes {
  Vec3 right, up, back;
};

Vec3 unit_vector_of(UpAxis axis);

/// Seen from the front, the model's -z direction (with z up: y), turned by `azimuth` degrees about the up
/// axis to the right and by `elevation` degrees, -90 to 90, upwards.
ViewAxes view_axes(UpAxis up, double azimuth_degrees, double elevation_degrees);

/// A camera that frames points.
struct FramingCamera {
  Vec3 eye, look, up;
  double near = 0, far = 0;
  double distance = 0;  // from the eye to `look`, the middle of the points in depth
};

/// The largest values that decide a framing, over all points added: how far each side of a view volume of the
/// slopes given has to be moved out to hold them all.
class Framing {
 public:
  /// The picture shows angles of `fov_y_degrees` upwards; `aspect` is width / height. The points fill `share`
  /// of its width or of its height, and at most so much of the other.
  Framing(const ViewAxes& axes, double fov_y_degrees, double aspect, double share);

  void add(const Vec3& p);
  /// For points that do not all coincide. With `at`, it looks there instead; `zoom` divides its distance.
  [[nodiscard]] FramingCamera camera(const std::optional<Vec3>& at = std::nullopt, double zoom = 1) const;

 private:
  ViewAxes axes_;
  double slope_x_, slope_y_;
  double right_, left_, top_,
      bottom_;                 // the largest a + slope c and -a + slope c of points (a, b, c), the same for b
  double nearest_, farthest_;  // the largest and the smallest c
};

}  // namespace pipeline
