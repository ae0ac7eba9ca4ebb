#pragma once

#include <string>
#include <string_view>

#include "libpipeline/scene/model.h"
#include "tools/mesh2scene/model_files.h"

namespace pipeline {

/// Reads a model file in the format that its first bytes show, whatever its name; makes missing normals.
/// Throws InputError or std::runtime_error, whose message names the file.
Model read_model(const std::string& path, ModelFiles& files, double crease_degrees);

/// Gives meshes without normals one for every corner: of length 1, or 0 in a flat mesh (surface 0) and where
/// no triangle has an area. Meshes of one surface are smoothed together.
/// A corner's normal is the mean over its neighbors: the triangles at its position whose normals differ from
/// its own triangle's by at most `crease_degrees`. A neighbor's weight is its angle there times the area of
/// all triangles in its plane there. If one plane has over 80 % of the neighbors' area, a corner whose
/// triangle is within half the crease of that plane takes its normal, and any other the mean without that
/// plane. Where more than 256 triangles meet, the rule is simpler (smooth_normals.cpp, kMany).
void add_normals(Model& model, double crease_degrees);

constexpr const char* kPartlyColored = "some of its vertices have no color: they get the color of their mesh";

// The readers of formats fill a model that has only its name.

void read_ply(std::string_view bytes, Model& model);
void read_obj(std::string_view bytes, ModelFiles& files, Model& model);
void read_gltf(std::string_view bytes, ModelFiles& files, Model& model);

}  // namespace pipeline
