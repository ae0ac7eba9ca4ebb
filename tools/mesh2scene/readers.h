#pragma once

#include <string>
#include <string_view>

#include "libpipeline/scene/model.h"
#include "tools/mesh2scene/model_files.h"

namespace pipeline {

/// Reads a model file in the format that its first bytes show, whatever its name is; missing normals are
/// made. Throws InputError or std::runtime_error, whose message names the file.
Model read_model(const std::string& path, ModelFiles& files, double crease_degrees);

/// Gives meshes without normals a unit normal for every corner, those of one surface together: the mean of
/// the normals of those triangles at this position whose planes turn by at most `crease_degrees` from the
/// corner's own, weighted by the corner's angle and by the area in one plane. A plane with over 80 % of their
/// area keeps its normal, shared by triangles within half the crease; the rest are smoothed without that
/// plane. 0 where no triangle has an area.
void add_normals(Model& model, double crease_degrees);

// The readers of formats add to a model that has only its name.

void read_ply(std::string_view bytes, Model& model);
void read_obj(std::string_view bytes, ModelFiles& files, Model& model);
void read_gltf(std::string_view bytes, ModelFiles& files, Model& model);

}  // namespace pipeline
