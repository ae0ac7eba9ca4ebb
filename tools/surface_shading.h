#pragma once

#include <optional>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/stream/stage_reader.h"

namespace pipeline {

/// The color of pixels that show no triangle: black unless the header sets another.
Color background_color(const Appearance& appearance);

/// The shader of a text's triangles; none for a text without colors and lights, unless a wireframe is
/// requested (with pixels of that size). The default model: none without lights, phong with lights and
/// normals, flat with lights alone. An InputError if a model needs lights and there are none, or if there are
/// lights and the header has no projection.
std::optional<SurfaceShader> surface_shader(const StageReader& reader, const Viewport& screen,
                                            std::optional<ShadingModel> chosen,
                                            std::optional<PixelSize> wireframe);

}  // namespace pipeline
