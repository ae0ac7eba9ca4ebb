#pragma once

#include <cmath>
#include <limits>

#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// NDC depths from distances in front of the eye plane, and distances from depths, in doubles.
///
/// A perspective's depth is a - b / w, an orthographic one's a + b w; both grow with w.
class NdcDepth {
 public:
  explicit NdcDepth(const ProjectionTransform& projection)
      : is_perspective_(projection.is_perspective),
        a_((projection.far + projection.near) / (projection.far - projection.near)),
        b_(2 * projection.near * (projection.far / (projection.far - projection.near))) {
    if (is_perspective_) return;
    a_ = -a_;
    b_ = 2 / (projection.far - projection.near);
  }

  /// The depth of a point at `distance`, within 2^-50 of the sum of the sizes of its two parts.
  [[nodiscard]] double at(double distance) const {
    return is_perspective_ ? a_ - b_ / distance : a_ + b_ * distance;
  }
  /// A distance that no point of a depth up to `depth` exceeds, if the depths of `zbuf` are within
  /// `largest_depth` * 2^-49 of the exact ones.
  [[nodiscard]] double distance_up_to(double depth, double largest_depth) const {
    const double bound = depth + kCalculated * (std::fabs(a_) + std::fabs(depth) + largest_depth);
    if (!is_perspective_) {
      const double distance = (bound - a_) / b_;
      return distance + kCalculated * (std::fabs(distance) + std::fabs(a_ / b_));
    }
    const double part = a_ - bound;
    // Not greater: also if it is not a number.
    return part > 0 ? b_ / part * (1 + kCalculated) : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr double kCalculated = 0x1p-48;

  bool is_perspective_;
  double a_;
  double b_;
};

}  // namespace pipeline
