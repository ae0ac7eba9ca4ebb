#pragma once

#include <cstddef>

#include "libpipeline/scene/model.h"
#include "libpipeline/text/text_writer.h"
#include "tools/mesh2scene/scene_setting.h"

namespace pipeline {

/// The most materials of a scene: meshes with further ones have the first.
constexpr std::size_t kMostMaterials = 256;

/// Writes the model as a scene (docs/scene.md). Numbers of the file have their shortest form; cameras and
/// lights have five digits of the distance between eye and model. The transforms of nodes are applied to
/// their vertices; `as_nodes`, push, translate, rotate, scale and pop do it, where the file has them. False
/// if the model has more than kMostMaterials.
bool write_scene(const Model& model, const SceneSetting& setting, bool as_nodes, TextWriter& out);

}  // namespace pipeline
