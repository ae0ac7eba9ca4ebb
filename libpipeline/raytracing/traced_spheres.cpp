#include "libpipeline/raytracing/traced_spheres.h"

#include <optional>

namespace pipeline {

bool TracedSpheres::add(const TriangleBatch& p_view, std::size_t entry) {
  const std::optional<Ellipsoid> surface = Ellipsoid::from(p_view.sphere_points(entry));
  if (!surface) return false;
  const AttributeArrays& attributes = p_view.attributes;
  have_colors_ = !attributes.colors.empty();
  spheres_.push_back({*surface, have_colors_ ? attributes.colors[entry][0] : Vec3(), p_view.numbers[entry],
                      attributes.materials.empty() ? 0 : attributes.materials[entry]});
  return true;
}

}  // namespace pipeline
