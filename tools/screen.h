#pragma once

#include "libpipeline/scene/config.h"
#include "tools/tool.h"
#include "tools/zbuf_options.h"

namespace pipeline {

/// The screen of --size, with which INPUT is the only operand, or else of CONFIG. A UsageError if there is
/// neither, or an operand too many; an InputError or IoError of the config.
Viewport read_screen(Tool& tool, const ZbufOptions& chosen);

}  // namespace pipeline
