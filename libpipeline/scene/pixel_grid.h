#pragma once

#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The positions of a viewport's pixel centers in NDC, rounded: row 0 at the top, column 0 on the left. Their
/// error: tests/proofs/pixel_center.g.
struct PixelGrid {
  explicit PixelGrid(const Viewport& viewport)
      : columns(viewport.columns),
        rows(viewport.rows),
        half_width(-viewport.left),
        half_height(-viewport.bottom),
        left_x(viewport.left_x()),
        top_y(viewport.top_y()),
        dx(viewport.dx()),
        dy(viewport.dy()) {}

  [[nodiscard]] double x_of(int column) const { return left_x + column * dx; }
  [[nodiscard]] double y_of(int row) const { return top_y - row * dy; }

  int columns;
  int rows;
  double half_width;  // of the window, exactly; the numbers below are rounded
  double half_height;
  double left_x;
  double top_y;
  double dx;
  double dy;
};

}  // namespace pipeline
