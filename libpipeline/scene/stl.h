#pragma once

#include <string_view>

#include "libpipeline/scene/model.h"

namespace pipeline {

/// True if the bytes have the exact size of a binary STL file with the count of triangles in its header.
bool is_whole_binary_stl(std::string_view bytes);
/// True if the bytes are an STL file, text or binary.
bool is_stl(std::string_view bytes);

/// Adds the file's triangles to a model that has only its name. InputErrors and std::runtime_errors name it.
void read_stl(std::string_view bytes, Model& model);

}  // namespace pipeline
