#pragma once

#include <optional>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/stream/stage_reader.h"

namespace pipeline {

/// The color of pixels that show no triangle, black unless the text says another.
Color background_color(const Appearance& appearance);

/// What shades a text's triangles; nothing for a text without colors and lights, unless a
/// wireframe is asked for (with pixels of that size). Where nothing is chosen:
/// none without lights, phong with lights and normals, flat with lights alone. An InputError if light is
/// asked for and there is none, or if there are lights and the header does not say the projection.
std::optional<SurfaceShader> surface_shader(const StageReader& reader, const Viewport& screen,
                                            std::optional<ShadingModel> chosen,
                                            std::optional<PixelSize> wireframe);

}  // namespace pipeline
