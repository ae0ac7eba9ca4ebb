#pragma once

#include <string>

#include "libpipeline/text/text_writer.h"
#include "tools/mesh2scene/imported_model.h"
#include "tools/mesh2scene/scene_materials.h"
#include "tools/mesh2scene/scene_setting.h"

namespace pipeline {

/// How the transforms of a model's nodes get into the scene: its vertices are transformed, or push,
/// translate, rotate, scale and pop do it. A matrix with shear has no such commands, so its vertices are
/// transformed in any case.
enum class NodeForm { applied, as_commands };

/// The shortest text that reads back to the same float: the precision of assimp, and of what most files hold.
std::string float_text(double value);
/// The shortest texts of the three doubles.
std::string text_of(const Vec3& v);

/// Writes the model as a scene (docs/scene.md). Numbers of the file have their shortest form; those of a
/// camera or a light have five digits of the distance between eye and model.
void write_scene(const ImportedModel& model, const SceneSetting& setting, const SceneMaterials& materials,
                 NodeForm node_form, TextWriter& out);

}  // namespace pipeline
