#pragma once

#include <optional>
#include <string>

#include "libpipeline/scene/camera.h"
#include "tools/rim/tool.h"
#include "tools/zbuf/picture_options.h"

namespace pipeline {

/// The operand CONFIG, an empty NamedFile if there is none. With --size, a single operand is CONFIG if it is
/// a file that holds a config, else the tool's INPUT.
NamedFile config_of(Tool& tool, const PictureOptions& chosen);

/// The screen of `config`, of --size, or, with both, the limits of the config at the size of --size, with a
/// note if that stretches the picture. Throws a UsageError if there is neither, and the config's InputErrors
/// and IoErrors.
Viewport read_screen(Tool& tool, const PictureOptions& chosen, const NamedFile& config);

/// The note on a picture whose aspect ratio differs from its camera's by more than rounding to pixels, which
/// distorts squares. None for a perspective with AspectRule::angle, which may distort them.
std::optional<std::string> squeezed_note(const Projection& projection, const Viewport& screen);
/// The note for a projection already carried out. A window around the middle may come from a perspective by
/// either rule: then there is none.
std::optional<std::string> squeezed_note_of_projected(const Projection& projected, const Viewport& screen);

}  // namespace pipeline
