#pragma once

#include <optional>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/stream/unseen_places.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// A projection's view volume, for asking where triangles in view space lie.
class ViewVolume {
 public:
  /// Its planes are pulled in by `clip_inset`, as a ProjectionStage's.
  explicit ViewVolume(const ProjectionTransform& projection, double clip_inset = 0);

  /// None if some part of the triangle is inside or on the border, as far as 31 digits can tell. Behind: no
  /// corner is in front of the eye. Otherwise the first plane, in the order of UnseenPlace, that all corners
  /// are outside of; or, where clipping at several planes leaves nothing, the plane that takes the last of
  /// it.
  [[nodiscard]] std::optional<UnseenPlace> outside(const Triangle& p_view) const;

 private:
  ProjectionTransform projection_;
  double clip_inset_;
  ProjectionCoefficients coefficients_;
};

}  // namespace pipeline
