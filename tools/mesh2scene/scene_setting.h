#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/model.h"

namespace pipeline {

/// The part of a scene before its first triangle.
struct SceneSetting {
  std::vector<std::string> comments;
  ModelCamera camera;  // in the model's space, as are the lights
  double scale = 1;   // of the model in the scene: a power of ten, for a size that seven decimals do not suit
  double aspect = 0;  // width / height
  Vec3 background;
  Vec3 ambient;
  /// At points.
  std::vector<ModelLight> lights;
  /// The color of meshes without one, from 0 to 255; or of all.
  Vec3 color;
  bool has_one_color = false;
};

/// The view of a framed model; angles in degrees.
struct ViewChoice {
  Vec3 up;  // an axis
  double azimuth_degrees = 30, elevation_degrees = 15;
  double fov_y_degrees = 30;
  double aspect = 0;
  std::optional<Vec3> at;  // the point looked at, in place of the model's middle
  double zoom = 1;         // how many times nearer the eye is
};

/// A camera that frames the model. std::runtime_error if all of its vertices coincide, or lie behind the eye.
SceneSetting framed_setting(const Model& model, const ViewChoice& view);
/// The file's own camera, which must be there; `aspect` is the picture's, width / height. Both settings take
/// the file's own lights, and have a key, a fill and an ambient light only if there are none.
SceneSetting setting_of_file(const Model& model, double aspect);

/// The share of the picture that the model covers, about: half of its triangles' areas, overlaps included.
double shown_share(const Model& model, const SceneSetting& setting);

}  // namespace pipeline
