#pragma once

#include <string>

#include "libpipeline/scene/model.h"
#include "libpipeline/text/text_writer.h"
#include "tools/mesh2scene/scene_materials.h"
#include "tools/mesh2scene/scene_setting.h"

namespace pipeline {

/// The shortest texts of the three doubles.
std::string text_of(const Vec3& v);

/// Writes the model as a scene (docs/scene.md). Numbers of the file have their shortest form; cameras and
/// lights have five digits of the distance between eye and model. The transforms of nodes are
/// applied to their vertices; `as_nodes`, push, translate, rotate, scale and pop do it, where the file has
/// them.
void write_scene(const Model& model, const SceneSetting& setting, const SceneMaterials& materials,
                 bool as_nodes, TextWriter& out);

}  // namespace pipeline
