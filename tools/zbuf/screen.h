#pragma once

#include "libpipeline/scene/config.h"
#include "tools/rim/tool.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The operand CONFIG, without a name if there is none. With --size, a single operand is CONFIG if it is a
/// file that holds a config, else the tool's INPUT.
NamedFile config_of(Tool& tool, const ZbufOptions& chosen);

/// The screen of `config`, of --size, or, with both, the limits of the config at the size of --size, with a
/// note if that stretches the picture. A UsageError if there is neither; an InputError or IoError of the
/// config.
Viewport read_screen(Tool& tool, const ZbufOptions& chosen, const NamedFile& config);

}  // namespace pipeline
