#pragma once

#include <optional>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/stream/unseen_places.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// A projection's view volume, to locate triangles in view space.
class ViewVolume {
 public:
  /// Its planes are pulled in by `clip_inset`, like a ProjectionStage's.
  explicit ViewVolume(const ProjectionTransform& projection, double clip_inset = 0);

  /// None if part of the triangle is inside or on the border, as far as 31 digits can tell; `behind` if no
  /// corner is in front of the eye. Otherwise the first plane, in the order of UnseenPlace, with all corners
  /// outside; or, if only clipping at several planes leaves nothing, the plane that cuts off the last part.
  [[nodiscard]] std::optional<UnseenPlace> outside(const Triangle& p_view) const;

 private:
  ProjectionTransform projection_;
  double clip_inset_;
  ProjectionCoefficients coefficients_;
};

}  // namespace pipeline
