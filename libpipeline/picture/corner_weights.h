#pragma once

#include <array>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/vertex_columns.h"

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

  /// x and y of clip space, and w for z, over the largest |w|.
  [[nodiscard]] const Triangle& scaled() const { return scaled_; }
  /// In doubles, weights are certain where 2^16 times the sum of the determinants of scaled() exceeds this.
  [[nodiscard]] double doubt() const { return doubt_; }
  /// Wherever the center lies.
  [[nodiscard]] Weights exactly_at(const PixelGrid& grid, int row, int column) const;

 private:
  [[nodiscard]] bool are_plain(const PixelGrid& grid) const;

  Triangle scaled_;
  Triangle corners_;  // as given, with w for z
  bool are_divided_ = false;
  double doubt_ = 0;  // -1 if doubles are enough, whichever pixel is asked for
};

/// x and y of clip space, and w for z. Only their ratios count: scaled like this, nothing leaves a double's
/// range.
Triangle screen_corners_of(const ClipTriangle& corners, bool are_divided);

}  // namespace pipeline
