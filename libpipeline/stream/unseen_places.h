#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {

/// Why a triangle, or a sphere, shows at no pixel: the first that applies, in order; fragments come last.
enum class UnseenPlace {
  behind,  // the eye, all of it
  near,    // all of it before the near plane or front limit, or a fragment, if none is visible
  far,     // likewise beyond the far plane or rear limit
  left,    // of the view volume or the window, all of it
  right,   // likewise ...
  below,
  above,
  without_area,     // as seen from the eye
  between_centers,  // it covers no pixel
  elsewhere         // no ray meets it, and no other place describes it
};

/// Triangles or spheres by their place, with their extents.
struct UnseenPlaces {
  struct Group {
    std::uint64_t count = 0;
    BoundingBox extent;
  };
  void add(UnseenPlace place, const BoundingBox& extent) {
    Group& group = groups[static_cast<std::size_t>(place)];
    ++group.count;
    group.extent.add(extent);
  }
  [[nodiscard]] const Group& operator[](UnseenPlace place) const {
    return groups[static_cast<std::size_t>(place)];
  }

  std::array<Group, static_cast<std::size_t>(UnseenPlace::elsewhere) + 1> groups;
};

}  // namespace pipeline
