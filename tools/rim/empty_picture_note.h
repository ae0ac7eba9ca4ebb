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

// The notes of stages about a picture that is empty, or probably not as intended.

/// For `model`: the scene has no triangle, or a scale by 0 has left no triangle an area.
std::string empty_scene_note(std::uint64_t triangle_count, const std::optional<SourceLocation>& scale_by_0);

/// For `project`: all triangles were dropped, `culled_count` of them by their winding.
std::string dropped_note(const UnseenPlaces& outside, std::uint64_t culled_count);

/// For `project`: `hidden_count` triangles would be in view if the field of view were 57.3 times as wide.
/// `is_filled`: something is in view, but no vertex, so one triangle may fill the picture.
std::string radians_note(double fov_y_degrees, std::uint64_t hidden_count, bool is_filled);

/// For `model`: a light whose intensity looks like a color from 0 to 255; none if no light does. With an
/// attenuation, a light may have any intensity.
std::optional<std::string> bright_light_note(const Appearance& appearance);

/// For `zbuf`: no triangle shows at a pixel or, unless `is_empty`, only lines show.
std::string unseen_note(const UnseenPlaces& unseen, const Viewport& screen, bool is_empty);

/// For `zbuf`: all triangles together are a speck.
std::string speck_note(const BoundingBox& extent, const Viewport& screen);

/// For `zbuf`: a material mirrors or is clear, which only rays show; none if there is no such material.
std::optional<std::string> opaque_note(const Appearance& appearance);

/// The settings of a picture's colors.
struct ColorSetting {
  Color background;
  bool is_wireframe = false;
  bool has_noted_brightness = false;
};

/// The reason why hardly any drawn pixel shows anything; none if enough do.
std::optional<std::string> odd_colors_note(const ShownColors& shown, const ColorSetting& setting);

/// Spheres by their place in view space, with extents in z alone, and the limits there.
struct UnseenSpheres {
  UnseenPlaces places;
  double front = 0, rear = 0;
  bool front_is_near = true, rear_is_far = true;
};

/// For `trace`: no ray hits a sphere.
std::string unseen_spheres_note(const UnseenSpheres& spheres);

}  // namespace pipeline
