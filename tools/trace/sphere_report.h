#pragma once

#include <array>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/transform.h"
#include "tools/rim/empty_picture_note.h"

namespace pipeline {

/// The places of a text's spheres in view space, for a note if no ray meets one.
class SphereReport {
 public:
  SphereReport(const ProjectionTransform& projection, const Viewport& screen);

  void add(const TriangleBatch& p_view);
  [[nodiscard]] const UnseenSpheres& spheres() const { return spheres_; }

 private:
  /// A plane of the pyramid, or of the box, of the primary rays: points with x, y and z of view space are
  /// outside where x x_factor + y y_factor + z z_factor + offset is below 0.
  struct Plane {
    Vec3 factors;
    double offset;
    UnseenPlace outside;
  };

  [[nodiscard]] UnseenPlace place_of(const SpherePoints& points, double low, double high) const;

  UnseenSpheres spheres_;
  bool is_perspective_;
  std::array<Plane, 4> planes_;
};

}  // namespace pipeline
