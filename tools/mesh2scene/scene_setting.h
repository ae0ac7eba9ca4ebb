#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "tools/mesh2scene/imported_model.h"

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

/// The part of a scene before its first triangle.
struct SceneSetting {
  std::vector<std::string> comments;
  FramingCamera camera;
  double fov_y_degrees = 0;
  double aspect = 0;  // width / height
  Vec3 background;
  Vec3 ambient;
  /// At points, in the model's space.
  std::vector<ModelLight> lights;
  /// Of meshes without a color, from 0 to 255; or of all.
  Vec3 color;
  bool has_one_color = false;
};

/// From where a framed model is seen; angles in degrees.
struct ViewChoice {
  UpAxis up = UpAxis::y;
  double azimuth_degrees = 30, elevation_degrees = 15;
  double fov_y_degrees = 30;
  double aspect = 0;
  std::optional<Vec3> at;  // the point looked at, in place of the model's middle
  double zoom = 1;         // how many times nearer the eye is
};

/// A camera that frames the model. std::runtime_error if all of its vertices coincide, or lie behind the eye.
SceneSetting framed_setting(const ImportedModel& model, const ViewChoice& view);
/// The file's own camera, which must be there; `aspect` is the picture's, width / height. Both settings take
/// the file's own lights, and have a key, a fill and an ambient light only if there are none.
SceneSetting setting_of_file(const ImportedModel& model, double aspect);

}  // namespace pipeline
