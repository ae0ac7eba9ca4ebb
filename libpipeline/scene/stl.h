#pragma once

#include <string_view>

#include "libpipeline/scene/model.h"

namespace pipeline {

/// True if the bytes are an STL file, text or binary.
bool is_stl(std::string_view bytes);

/// Adds the file's triangles to a model that has only its name. An InputError or std::runtime_error names it.
void read_stl(std::string_view bytes, Model& model);

}  // namespace pipeline
