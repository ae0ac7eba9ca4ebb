#pragma once

#include "libpipeline/scene/viewport.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/trace/trace_options.h"

namespace pipeline {

/// Traces rays to the tool's input and writes image and depths, each if requested, the same on any number of
/// threads; depths of triangles as zbuf --coverage center does. No file replaces an older one before
/// everything is written. Notes why the image is empty, if it is.
void trace(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics);

}  // namespace pipeline
