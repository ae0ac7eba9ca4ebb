#pragma once

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

}  // namespace pipeline
