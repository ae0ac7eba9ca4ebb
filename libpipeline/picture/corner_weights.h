#pragma once

#include <array>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/vertex_columns.h"

namespace pipeline {

/// The weights of a triangle's corners, in view space, at the centers of pixels; each is within 2^-32 of the
/// exact weight. Wherever the corners lie, the sum of the determinants has the sign of the winding (M. Olano,
/// T. Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997). A center may lie a little
/// outside, so weights are clamped to [0, 1].
class CornerWeights {
 public:
  using Weights = std::array<double, 3>;

  CornerWeights() = default;
  /// `corners` are in clip space, or in NDC if they `are_divided` by w.
  CornerWeights(const PixelGrid& grid, const ClipTriangle& corners, bool are_divided);

  /// The corners' x, y and w (in z) of clip space, divided by the largest |w|.
  [[nodiscard]] const Triangle& scaled() const { return scaled_; }
  /// Weights in doubles are certain where 2^16 times the sum of the determinants of scaled() exceeds this.
  [[nodiscard]] double doubt() const { return doubt_; }
  /// The weights at a pixel's center, wherever it lies.
  [[nodiscard]] Weights exactly_at(const PixelGrid& grid, int row, int column) const;

 private:
  [[nodiscard]] bool are_plain(const PixelGrid& grid) const;

  Triangle scaled_;
  Triangle corners_;  // as given, with w in z
  bool are_divided_ = false;
  double doubt_ = 0;  // -1 if doubles are enough at every pixel
};

}  // namespace pipeline
