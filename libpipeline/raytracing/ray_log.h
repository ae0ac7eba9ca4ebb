#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

enum class RayKind { primary, shadow, mirrored, refracted };

/// A ray that takes part in the color of a pixel.
struct LoggedRay {
  RayKind kind;
  int depth;                                 // 0 for a primary ray, else 1 more than the parent ray
  double weight;                             // the largest part that it can have of the pixel's color
  Vec3 origin;                               // in view space
  bool is_cut = false;                       // not cast
  std::optional<std::uint64_t> object = {};  // the number of what it meets; none if it meets nothing
  std::optional<std::size_t> light = {};     // the number of the light that a shadow ray goes to
  Vec3 point = {};                           // where it meets that
  Vec3 direction = {};                       // of length 1, if it meets nothing
  bool is_front = true;
  bool is_sphere = false;
  Vec3 brought = {};  // a color; of a shadow ray the part of the light that comes through
};

/// The rays that make the color of a pixel, each after the one it comes from.
struct RayLog : std::vector<LoggedRay> {
  /// Adds a ray and returns its place.
  std::size_t add(const LoggedRay& ray) {
    push_back(ray);
    return size() - 1;
  }
};

/// Facts about all rays, for the note on a picture that shows nothing.
struct ShownLight {
  bool has_seen = false;         // a surface
  bool shows_something = false;  // a color other than the background's, by more than one step in a channel
  bool has_facing_light = false;
  bool has_arriving_light = false;  // some part of a light that faces a surface
  bool is_cut = false;              // a ray
  /// The greatest channel of surfaces whose own color counts; none if mirrors and glass alone are seen.
  std::optional<double> greatest_channel;

  void add(const ShownLight& other) {
    has_seen |= other.has_seen;
    shows_something |= other.shows_something;
    has_facing_light |= other.has_facing_light;
    has_arriving_light |= other.has_arriving_light;
    is_cut |= other.is_cut;
    greatest_channel = std::max(greatest_channel, other.greatest_channel);  // none is the least
  }
};

}  // namespace pipeline
