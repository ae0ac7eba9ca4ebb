#pragma once

#include "libpipeline/color.h"
#include "libpipeline/config.h"
#include "libpipeline/raster.h"
#include "libpipeline/span.h"
#include "libpipeline/visible_row.h"

namespace pipeline {

/// The visibility algorithm `zbuffer`: every pixel keeps the nearest depth drawn so far and its colour, 12
/// bytes a pixel. Source: E. Catmull, "A subdivision algorithm for computer display of curved surfaces",
/// 1974.
class ZBuffer {
 public:
  /// A buffer of the screen's size, every pixel at the rear limit and of the colour `background`.
  explicit ZBuffer(const ScreenConfig& screen, Color background = {});

  /// Draws a span of a triangle of the colour `color`. A pixel is written if its depth is less than the one
  /// there (of equal depths the first drawn stays) and not less than the front limit.
  void draw(const Span& span, Color color);

  /// Calls `visit(VisibleRow)` for every row of the screen, from the top.
  template <typename Visitor>
  void for_each_row(Visitor&& visit) const {
    for (int row = 0; row < depths_.rows(); ++row) visit(VisibleRow{depths_.row(row), colors_.row(row)});
  }

 private:
  double front_;
  Raster<double> depths_;
  Raster<Color> colors_;
};

}  // namespace pipeline
