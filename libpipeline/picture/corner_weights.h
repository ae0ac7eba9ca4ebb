#pragma once

#include <algorithm>
#include <array>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/scene/vertex_attributes.h"

namespace pipeline {

/// The weights of a triangle's corners, in view space, at the centers of pixels: each within 2^-32 of the
/// exact one. Wherever the corners lie, the sum of the determinants has the sign of the winding (M. Olano,
/// T. Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997). A center may lie a little
/// outside, so weights are clamped to [0, 1].
class CornerWeights {
 public:
  using Weights = std::array<double, 3>;

  CornerWeights() = default;
  /// The positions of `corners` are in clip space, or in NDC if they `are_divided` by w.
  CornerWeights(const PixelGrid& grid, const ClipTriangle& corners, bool are_divided);

  [[nodiscard]] Weights at(const PixelGrid& grid, const PixelCenter& pixel) const {
    const auto& [a, b, c] = scaled_;
    Weights weights = {area(b, c, pixel), area(c, a, pixel), area(a, b, pixel)};
    const double sum = weights[0] + weights[1] + weights[2];
    if (!are_plain_ && !are_certain(grid, sum)) return exactly_at(grid, pixel);
    const double side = sum < 0 ? -1 : 1;
    for (double& weight : weights) weight = std::max(side * weight, 0.0);
    return normalized(weights);
  }

 private:
  /// Twice the signed area that the points p and q of the screen make with a pixel's center, times their w. A
  /// point is x and y of clip space, and w for z, of any sign.
  static double area(const Vec3& p, const Vec3& q, const PixelCenter& pixel) {
    const double x = pixel.x, y = pixel.y;
    return (p.x - x * p.z) * (q.y - y * q.z) - (p.y - y * p.z) * (q.x - x * q.z);
  }
  /// Divided by their sum.
  template <typename Number>
  static std::array<Number, 3> normalized(const std::array<Number, 3>& numbers) {
    const Number sum = numbers[0] + numbers[1] + numbers[2];
    return {numbers[0] / sum, numbers[1] / sum, numbers[2] / sum};
  }

  [[nodiscard]] bool are_certain(const PixelGrid& grid, double sum) const;
  [[nodiscard]] bool are_plain(const PixelGrid& grid) const;
  [[nodiscard]] Weights exactly_at(const PixelGrid& grid, const PixelCenter& pixel) const;

  Triangle scaled_;   // x and y of clip space, and w for z, over the largest |w|
  Triangle corners_;  // as given, with w for z
  bool are_divided_ = false;
  bool are_plain_ = false;  // doubles are enough, whichever pixel is asked for
};

/// x and y of clip space, and w for z. Only their ratios count: scaled like this, nothing leaves a double's
/// range.
Triangle screen_corners_of(const ClipTriangle& corners, bool are_divided);

}  // namespace pipeline
