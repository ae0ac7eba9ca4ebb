#pragma once

#include <CLI/CLI.hpp>

#include "tools/render.h"

namespace pipeline {

/// What makes another picture of the same triangles: `--depth-image`, `--depth-epsilon`, `--samples`,
/// `--shading`, `--wireframe`.
void add_picture_options(CLI::App& options, RenderOptions& chosen);

/// A UsageError if options do not go together.
void check_picture_options(const RenderOptions& chosen);

}  // namespace pipeline
