#pragma once

#include <optional>
#include <string>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/model.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// The part of a scene before its first triangle.
struct SceneSetting {
  std::string comment;
  ModelCamera camera;  // in the model's space, like the lights
  double scale = 1;    // of the model in the scene: a power of ten, if seven decimals do not suit its size
  double aspect = 0;   // width / height
  Vec3 ambient;
  std::vector<ModelLight> lights;  // point lights
  std::optional<Vec3> color;       // of all meshes
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

/// The maximum number of a scene's materials: meshes with further ones get the first.
constexpr std::size_t kMostMaterials = 256;

/// Writes the model as a scene (docs/scene.md). The file's numbers have their shortest form; positions of
/// camera and lights have five digits of the distance between eye and model. Nodes' transforms are applied to
/// their vertices; with `as_nodes`, they are written as commands where the file gives them in steps. False if
/// the model has more than kMostMaterials.
bool write_scene(const Model& model, const SceneSetting& setting, bool as_nodes, TextWriter& out);

}  // namespace pipeline
