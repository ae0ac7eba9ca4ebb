#pragma once

#include <cstddef>

#include "libpipeline/scene/model.h"
#include "libpipeline/text/text_writer.h"
#include "tools/mesh2scene/scene_setting.h"

namespace pipeline {

/// The maximum number of a scene's materials: meshes with further ones get the first.
constexpr std::size_t kMostMaterials = 256;

/// Writes the model as a scene (docs/scene.md). The file's numbers have their shortest form; positions of
/// camera and lights have five digits of the distance between eye and model. Nodes' transforms are applied to
/// their vertices; with `as_nodes`, they are written as commands where the file gives them in steps. False if
/// the model has more than kMostMaterials.
bool write_scene(const Model& model, const SceneSetting& setting, bool as_nodes, TextWriter& out);

}  // namespace pipeline
