#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "libpipeline/picture/shown_colors.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/unseen_places.h"
#include "libpipeline/text/source_location.h"

namespace pipeline {

struct Appearance;
struct Viewport;

// The words with which a stage notes why the picture is empty, or far from what was meant.

/// For `model`: the scene has no triangle, or a scale by 0 left none of them an area.
std::string empty_scene_note(std::uint64_t triangle_count, const std::optional<SourceLocation>& scale_by_0);

/// For `project`: all triangles were dropped, `culled_count` by their winding.
std::string dropped_note(const UnseenPlaces& outside, std::uint64_t culled_count);

/// For `project`: `hidden_count` triangles would be in view if the field of view were 57.3 times as wide.
/// `is_filled`: something is in view, but no vertex, so that one triangle may fill the picture.
std::string radians_note(double fov_y_degrees, std::uint64_t hidden_count, bool is_filled);

/// For `model`: a light whose intensity looks like a color from 0 to 255; none if no light does. With an
/// attenuation, a light may have any intensity.
std::optional<std::string> bright_light_note(const Appearance& appearance);

/// For `zbuf`: no triangle shows at a pixel; or not `is_empty`, and those that show are lines.
std::string unseen_note(const UnseenPlaces& unseen, const Viewport& screen, bool is_empty);

/// For `zbuf`: all triangles together are a speck.
std::string speck_note(const BoundingBox& extent, const Viewport& screen);

/// For `zbuf`: a material mirrors or is clear, which only rays show; none if none does.
std::optional<std::string> opaque_note(const Appearance& appearance);

/// How a picture gets its colors.
struct ColorSetting {
  Color background;
  bool is_wireframe = false;
  bool has_noted_brightness = false;
};

/// Why hardly a pixel of what is drawn shows anything; none if enough pixels do.
std::optional<std::string> odd_colors_note(const ShownColors& shown, const ColorSetting& setting);

/// Spheres by their place in view space, of which z alone is known, and the limits there.
struct UnseenSpheres {
  UnseenPlaces places;
  double front = 0, rear = 0;
  bool front_is_near = true, rear_is_far = true;
};

/// For `trace`: no ray meets a sphere.
std::string unseen_spheres_note(const UnseenSpheres& spheres);

}  // namespace pipeline
