#pragma once

#include <string>
#include <string_view>

#include "libpipeline/scene/model.h"
#include "tools/mesh2scene/model_files.h"

namespace pipeline {

/// Reads a model file in the format that its first bytes show, whatever its name; makes missing normals.
/// Throws InputError or std::runtime_error, whose message names the file.
Model read_model(const std::string& path, ModelFiles& files, double crease_degrees);

/// Gives meshes without normals a unit normal for every corner; meshes of one surface are smoothed together.
/// It is the mean of the normals of the triangles at this position whose planes turn by at most
/// `crease_degrees` from the corner's own, weighted by angle and by the area in one plane. A plane with over
/// 80 % of their area keeps its normal, which triangles within half the crease share; the others are smoothed
/// without it. 0 if no triangle has an area.
void add_normals(Model& model, double crease_degrees);

// The readers of formats fill a model that has only its name.

void read_ply(std::string_view bytes, Model& model);
void read_obj(std::string_view bytes, ModelFiles& files, Model& model);
void read_gltf(std::string_view bytes, ModelFiles& files, Model& model);

}  // namespace pipeline
