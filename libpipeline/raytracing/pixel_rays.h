#pragma once

#include <cmath>
#include <limits>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// A ray in view space: the points origin + t direction. A primary ray's direction has z = -1, so that t is
/// the distance in front of the eye plane: the w of a perspective's clip space.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// The primary rays of a screen: through the centers of its pixels, from the eye or parallel.
/// In x and y of view space, at the distance w, a ray is within 2^-49 reach w of the exact one (2^-49 reach
/// if parallel): 2^-50 of the window for the center (tests/proofs/pixel_center.g), and one rounding each for
/// the two entries of the matrix, the sum and the quotient.
class PixelRays {
 public:
  PixelRays(const ProjectionTransform& projection, const Viewport& screen)
      : grid_(screen),
        is_perspective_(projection.is_perspective),
        x_scale_(projection.x_scale.nearest_double()),
        y_scale_(projection.y_scale.nearest_double()),
        x_offset_(projection.x_offset.nearest_double()),
        y_offset_(projection.y_offset.nearest_double()),
        reach_((grid_.half_width + std::fabs(x_offset_)) / std::fabs(x_scale_) +
               (grid_.half_height + std::fabs(y_offset_)) / std::fabs(y_scale_)) {}

  [[nodiscard]] Ray ray(int row, int column) const {
    const double x = grid_.x_of(column), y = grid_.y_of(row);
    if (is_perspective_) return {{}, {(x + x_offset_) / x_scale_, (y + y_offset_) / y_scale_, -1}};
    return {{(x - x_offset_) / x_scale_, (y - y_offset_) / y_scale_, 0}, {0, 0, -1}};
  }
  [[nodiscard]] bool is_perspective() const { return is_perspective_; }
  /// A bound on |x| + |y| of the window and the frustum's axis, in view space: at distance 1, or anywhere if
  /// parallel.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  PixelGrid grid_;
  bool is_perspective_;
  double x_scale_, y_scale_, x_offset_, y_offset_;
  double reach_;
};

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
  /// An upper bound on the distances of points with depths up to `depth`, if the depths of `zbuf` are within
  /// `largest_depth` * 2^-49 of the exact ones.
  [[nodiscard]] double distance_up_to(double depth, double largest_depth) const {
    const double bound = depth + kCalculated * (std::fabs(a_) + std::fabs(depth) + largest_depth);
    if (!is_perspective_) {
      const double distance = (bound - a_) / b_;
      return distance + kCalculated * (std::fabs(distance) + std::fabs(a_ / b_));
    }
    const double part = a_ - bound;
    // The else branch also takes NaN.
    return part > 0 ? b_ / part * (1 + kCalculated) : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr double kCalculated = 0x1p-48;

  bool is_perspective_;
  double a_;
  double b_;
};

}  // namespace pipeline
