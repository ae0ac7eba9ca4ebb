#pragma once

#include "libpipeline/scene/viewport.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/trace/trace_options.h"

namespace pipeline {

/// Traces rays to the triangles of the tool's input and writes the image and the depths, as far as each is
/// wanted: those that `project --digits exact | zbuf --coverage center` write, on any number of threads. No
/// file replaces an older one before everything is written. Notes why the image is empty, if it is.
void trace(Tool& tool, const TraceOptions& chosen, const Viewport& screen, Statistics& statistics);

}  // namespace pipeline
