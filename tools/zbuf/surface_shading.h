#pragma once

#include <optional>
#include <vector>

#include "libpipeline/picture/shading.h"
#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/stream/stage_text.h"
#include "libpipeline/stream/triangle_batch.h"
#include "tools/zbuf/picture_options.h"

namespace pipeline {

/// The message on a background that is not opaque.
std::string refused_background(Color background);

/// The color of pixels that show no triangle: black unless one is chosen or the header sets one.
Color background_color(const Appearance& appearance, std::optional<Color> chosen);

/// The lights of a scene.
Lighting lighting_of(const Appearance& appearance, bool is_perspective);

/// The materials by their numbers; without a line `material`, only the default.
std::vector<Material> materials_of(const Appearance& appearance);

/// Gives the triangles of a painted text their materials' paints, or white.
void add_material_colors(const Appearance& appearance, TriangleBatch& batch);

/// The chosen shading model; by default, none without lights, phong with lights and normals, flat with lights
/// alone.
ShadingModel shading_model(const Appearance& appearance, std::optional<ShadingModel> chosen);

/// The shader of the triangles of a projected text; none for a text without colors and lights, unless a
/// wireframe is requested. The header of a text with lights must have its projection. An InputError if a
/// model needs lights and there are none, or if the header's background is not opaque and the image cannot
/// hold an alpha. InputErrors name `header_end`, the place after the header, or a refused background's line.
std::optional<SurfaceShader> surface_shader(const StageHeader& header, const SourceLocation& header_end,
                                            const Viewport& screen, const PictureOptions& chosen,
                                            bool is_wireframe = false);

}  // namespace pipeline
