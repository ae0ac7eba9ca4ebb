#pragma once

#include <cstddef>
#include <vector>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/scene.h"

namespace pipeline {

/// Cuts spheres into facets: N belts from pole to pole, along z, of 2 N quadrilaterals each. A quadrilateral
/// is two facets; at the poles it is a triangle, and one facet.
class SphereFacets {
 public:
  static constexpr std::size_t kMinBelts = 2;
  static constexpr std::size_t kMaxBelts = 10000;

  explicit SphereFacets(std::size_t belt_count);

  /// A triangle with its corners on the sphere, counterclockwise from outside, and the normals at them.
  struct Facet {
    Triangle corners;
    std::array<Vec3, 3> normals;
  };
  [[nodiscard]] std::size_t size() const { return 4 * belts_ * (belts_ - 1); }
  [[nodiscard]] Facet operator()(const SphereCommand& sphere, std::size_t index) const;

 private:
  [[nodiscard]] Vec3 normal(std::size_t belt, std::size_t meridian) const;

  std::size_t belts_;
  // Indexed by multiples of 180 degrees / belts_, up to 360.
  std::vector<double> sines_, cosines_;
};

}  // namespace pipeline
