#pragma once

#include "tools/command_line.h"
#include "tools/render.h"

namespace pipeline {

/// What makes another picture of the same triangles: `--depth-image`, `--depth-epsilon`, `--samples`,
/// `--shading`, `--wireframe`.
void add_picture_options(CommandLine& options, RenderOptions& chosen);

/// A UsageError if options do not go together.
void check_picture_options(const RenderOptions& chosen);

}  // namespace pipeline
