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
  ModelCamera camera;  // in the model's space, like the lights
  double scale = 1;    // of the model in the scene: a power of ten, if seven decimals do not suit its size
  double aspect = 0;   // width / height
  Vec3 background;
  Vec3 ambient;
  /// Point lights.
  std::vector<ModelLight> lights;
  /// The color of meshes without their own, or of all, from 0 to 255.
  Vec3 color;
  bool has_one_color = false;
};

/// The view of a framed model; angles in degrees.
struct ViewChoice {
  Vec3 up;  // an axis
  double azimuth_degrees = 30, elevation_degrees = 15;
  double fov_y_degrees = 30;
  double aspect = 0;
  std::optional<Vec3> at;  // the point looked at, instead of the model's middle
  double zoom = 1;         // the factor by which the eye is nearer
};

/// A camera that frames the model. std::runtime_error if all of its vertices coincide, or lie behind the eye.
SceneSetting framed_setting(const Model& model, const ViewChoice& view);
/// The file's own camera, which must be there; `aspect` is the picture's, width / height. Both settings take
/// the file's lights; without any, they have a key, a fill and an ambient light.
SceneSetting setting_of_file(const Model& model, double aspect);

/// The approximate share of the picture that the model covers: half of its triangles' areas, even if they
/// overlap.
double shown_share(const Model& model, const SceneSetting& setting);

}  // namespace pipeline
