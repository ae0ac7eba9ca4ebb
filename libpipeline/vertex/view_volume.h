#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "libpipeline/numbers/bounding_box.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// Where a triangle lies that has no part in the view volume.
enum class OutsidePart { behind, near, far, left, right, below, above };
constexpr std::size_t kOutsidePartCount = 7;

/// A projection's view volume, for asking where triangles in view space lie.
class ViewVolume {
 public:
  /// Its planes are pulled in by `clip_inset`, as a ProjectionStage's.
  explicit ViewVolume(const ProjectionTransform& projection, double clip_inset = 0);

  /// None if some part of the triangle is inside or on the border, as far as 31 digits can tell. Behind: no
  /// corner is in front of the eye. Otherwise the first plane, in the order above, that all corners are
  /// outside of; or, where clipping at several planes leaves nothing, the plane that takes the last of it.
  [[nodiscard]] std::optional<OutsidePart> outside(const Triangle& p_view) const;

 private:
  ProjectionTransform projection_;
  double clip_inset_;
  ProjectionCoefficients coefficients_;
};

/// How many triangles lie outside the view volume, by where, and between which coordinates in view space.
struct OutsideCounts {
  struct Group {
    std::uint64_t count = 0;
    BoundingBox extent;
  };
  void add(OutsidePart part, const Triangle& p_view) {
    Group& group = groups[static_cast<std::size_t>(part)];
    ++group.count;
    group.extent.add(p_view);
  }
  [[nodiscard]] const Group& operator[](OutsidePart part) const {
    return groups[static_cast<std::size_t>(part)];
  }

  std::array<Group, kOutsidePartCount> groups;
};

}  // namespace pipeline
