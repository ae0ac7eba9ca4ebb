#pragma once

#include <array>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"

namespace pipeline {

/// A pixel of an edge, or a sample of one.
struct EdgePixel {
  int row;
  int column;
  double depth;
};

/// Adds the pixels of a triangle's edges; edge i goes from corner i to the next, and `is_drawn` chooses among
/// them. In every column of pixels from one end of an edge to the other, both included, it has the one pixel
/// whose center is nearest, the upper of two; in every row the left of two if it spans more rows than
/// columns. The depth is the edge's in the middle of the column or row. The pixels are decided exactly, for
/// any finite coordinates; the edge's two triangles get the same pixels, with the same depths.
///
/// On a grid of samples the line is as wide as a pixel, `samples_per_pixel`. `rows` are the screen's
/// that are drawn.
void add_edge_pixels(const ExactGrid& grid, const ExactTriangle& triangle,
                     const std::array<bool, 3>& is_drawn, int samples_per_pixel, const RowRange& rows,
                     std::vector<EdgePixel>& pixels);

}  // namespace pipeline
