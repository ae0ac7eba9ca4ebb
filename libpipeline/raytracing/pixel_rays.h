#pragma once

#include <cmath>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// A ray in view space: the points origin + t direction. A primary ray's direction has z = -1, so that t is
/// the distance in front of the eye plane: the w of a perspective's clip space.
struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// The primary rays of a screen: from the eye, or parallel, through the centers of its pixels.
///
/// In x and y of view space, at the distance w, a ray is within 2^-49 reach w of the exact one (2^-49 reach,
/// if parallel): 2^-50 of the window for the center (tests/proofs/pixel_center.g), and a rounding each for
/// the two entries of the matrix, their sum and their quotient.
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
  /// A bound on |x| + |y| of the window and of the frustum's axis, in view space: at the distance 1, or
  /// anywhere if parallel.
  [[nodiscard]] double reach() const { return reach_; }

 private:
  PixelGrid grid_;
  bool is_perspective_;
  double x_scale_, y_scale_, x_offset_, y_offset_;
  double reach_;
};

}  // namespace pipeline
