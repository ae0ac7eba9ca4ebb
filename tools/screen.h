#pragma once

#include "libpipeline/scene/config.h"
#include "tools/tool.h"
#include "tools/zbuf_options.h"

namespace pipeline {

/// The screen of CONFIG, of --size, or, with both, the limits of CONFIG at the size of --size, with a note if
/// that stretches the picture. With --size, a single operand is CONFIG if it is a file that holds a config,
/// else INPUT. A UsageError if there is neither; an InputError or IoError of the config.
Viewport read_screen(Tool& tool, const ZbufOptions& chosen);

}  // namespace pipeline
