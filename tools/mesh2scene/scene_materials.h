#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/scene/model.h"
#include "tools/mesh2scene/scene_setting.h"

namespace pipeline {

/// The materials of a scene made from a model: each distinct one that a mesh has, in the order of the meshes.
/// They carry the colors of their meshes as paints, if all colors come from materials or the setting, and the
/// paints leave no more than kMaxCount.
struct SceneMaterials {
  /// More than these are not kept: each one more has the number 0.
  static constexpr std::size_t kMaxCount = 256;

  SceneMaterials(const Model& model, const SceneSetting& setting);

  std::vector<std::string> lines;  // `material` and perhaps `paint`, for each; at least one
  std::map<std::optional<std::size_t>, std::size_t> numbers;  // by the model's
  bool have_paints;
  bool are_too_many = false;  // more than kMaxCount

 private:
  void number_all(const Model& model, const SceneSetting& setting);
};

/// The color of a mesh without vertex colors, from 0 to 255.
Vec3 color_of(const ModelMesh& mesh, const Model& model, const SceneSetting& setting);

}  // namespace pipeline
