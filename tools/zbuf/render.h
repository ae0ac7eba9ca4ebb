#pragma once

#include "libpipeline/scene/viewport.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// Draws the tool's input and writes image, depths and visible triangles, each if requested. None depends on
/// the algorithm or on the number of threads. No file replaces an older one before everything is written.
/// Notes why the image is empty, if it is.
void render(Tool& tool, const ZbufOptions& chosen, const Viewport& screen, Statistics& statistics);

}  // namespace pipeline
