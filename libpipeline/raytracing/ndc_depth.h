#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// The z in NDC that `zbuf` gives a point is in here.
struct DepthInterval {
  double low;
  double high;
};

/// NDC depths from distances in front of the eye plane, in doubles and with bounds on their errors.
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

  /// Of a point at `distance`, known to a relative error of `error` (of `farthest`, if orthographic), in a
  /// triangle whose vertices are from `nearest` to `farthest` away. `zbuf` calculates it within 2^-50 of the
  /// triangle's largest |z|, from vertices rounded by 2^-53 of theirs.
  [[nodiscard]] DepthInterval at(double distance, double error, double nearest, double farthest) const {
    const double part = is_perspective_ ? b_ / distance : b_ * distance;
    const double depth = is_perspective_ ? a_ - part : a_ + part;
    const double most = is_perspective_
                            ? std::fabs(a_) + b_ / nearest
                            : std::fabs(a_) + b_ * std::max(std::fabs(nearest), std::fabs(farthest));
    const double part_error =
        is_perspective_ ? part * error : b_ * std::max(std::fabs(nearest), std::fabs(farthest)) * error;
    const double bound = 2 * part_error + kCalculated * most;
    return {depth - bound, depth + bound};
  }
  /// Of a point at `distance`, within 2^-50 of the sum of the sizes of its two parts.
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
