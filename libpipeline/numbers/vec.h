#pragma once

#include <array>

namespace pipeline {

/// A point or a direction; the name of the variable shows its space (p_world, p_view, p_ndc).
struct Vec3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Three vertices in the order they were given.
using Triangle = std::array<Vec3, 3>;

}  // namespace pipeline
