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
  double weight;                             // the largest part of the pixel's color that it can bring
  Vec3 origin;                               // in view space
  bool is_cut = false;                       // not cast
  std::optional<std::uint64_t> object = {};  // the number of the object that it meets, if any
  std::optional<std::size_t> light = {};     // the number of a shadow ray's light
  Vec3 point = {};                           // where it meets the object
  Vec3 direction = {};                       // of length 1, if it meets no object
  bool is_front = true;
  bool is_sphere = false;
  Vec3 brought = {};  // a color; for a shadow ray, the part of the light that arrives
};

/// The rays that make the color of a pixel, each after its parent.
using RayLog = std::vector<LoggedRay>;

}  // namespace pipeline
