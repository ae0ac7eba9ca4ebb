#pragma once

#include "libpipeline/scene/viewport.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/trace/trace_options.h"

namespace pipeline {

/// Traces rays to the triangles of the tool's input and writes image and depths, each if requested: on any
/// number of threads, those of `project --digits exact | zbuf --coverage center`. No file replaces an older
/// one before everything is written. Notes why the image is empty, if it is.
void trace(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics);

}  // namespace pipeline
