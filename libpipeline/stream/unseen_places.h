#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {

/// Why a triangle or sphere shows nowhere: the first reason that applies. Its fragments beyond the limits of
/// depth are looked at only after without_area.
enum class UnseenPlace {
  behind,  // all of it behind the eye
  near,    // all of it before the near plane or front limit; or a fragment is, and no fragment is visible
  far,     // likewise beyond the far plane or rear limit
  left,    // all of it left of the view volume or the window
  right,   // likewise ...
  below,
  above,
  without_area,     // as seen from the eye
  between_centers,  // it covers no pixel
  elsewhere         // no ray hits it, and no other reason applies
};

/// The unseen triangles or spheres by place, with their extents.
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
