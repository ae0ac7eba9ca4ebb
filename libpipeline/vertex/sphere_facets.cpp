#include "libpipeline/vertex/sphere_facets.h"

#include "libpipeline/numbers/angle.h"

namespace pipeline {

SphereFacets::SphereFacets(std::size_t belt_count) : belts_(belt_count) {
  for (std::size_t i = 0; i <= 2 * belts_; ++i) {
    const DoubleDouble degrees =
        DoubleDouble{180 * static_cast<double>(i)} / DoubleDouble{static_cast<double>(belts_)};
    const SineCosine angle = sine_cosine_of_degrees(degrees);
    sines_.push_back(angle.sine.nearest_double());
    cosines_.push_back(angle.cosine.nearest_double());
  }
}

Vec3 SphereFacets::normal(std::size_t belt, std::size_t meridian) const {
  return {sines_[belt] * cosines_[meridian], sines_[belt] * sines_[meridian], cosines_[belt]};
}

SphereFacets::Facet SphereFacets::operator()(const SphereCommand& sphere, std::size_t index) const {
  // The first belt and the last have one facet per quadrilateral, the others two.
  const std::size_t in_belt = 2 * belts_, place = (index + in_belt) % (2 * in_belt);
  const std::size_t belt = (index + in_belt) / (2 * in_belt);
  const bool is_first = belt == 0, is_last = belt == belts_ - 1;
  const std::size_t meridian = is_first ? index : is_last ? place : place / 2;
  const std::size_t half = is_first ? 0 : is_last ? 1 : place % 2;
  const Vec3 above_left = normal(belt, meridian), below_left = normal(belt + 1, meridian);
  const Vec3 above_right = normal(belt, meridian + 1), below_right = normal(belt + 1, meridian + 1);
  Facet facet;
  facet.normals = half == 0 ? std::array{above_left, below_left, below_right}
                            : std::array{above_left, below_right, above_right};
  const Vec3& center = sphere.center;
  const double radius = sphere.radius;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& n = facet.normals[i];
    facet.corners[i] = {center.x + radius * n.x, center.y + radius * n.y, center.z + radius * n.z};
  }
  return facet;
}

}  // namespace pipeline
