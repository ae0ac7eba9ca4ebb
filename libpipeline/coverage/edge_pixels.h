#pragma once

#include <array>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"

namespace pipeline {

/// A pixel of an edge, or a sample of such a pixel.
struct EdgePixel {
  int row;
  int column;
  double depth;
  std::size_t edge;
};

/// Adds the pixels of a triangle's edges; edge i goes from corner i to the next, and `is_drawn` chooses among
/// them. In every column of pixels that it spans, ends included, an edge has the pixel whose center is
/// nearest (the upper if two are); if it spans more rows than columns, it has one in every row (the left if
/// two are). The depth is the edge's in the middle of the column or row. The pixels are decided exactly, for
/// any finite coordinates; the two triangles that share an edge get the same pixels and depths. On a grid of
/// samples, the line is as wide as a pixel: `samples_per_pixel`. `rows` are the rows to draw.
void add_edge_pixels(const ExactGrid& grid, const ExactTriangle& triangle,
                     const std::array<bool, 3>& is_drawn, int samples_per_pixel, const RowRange& rows,
                     std::vector<EdgePixel>& pixels);

}  // namespace pipeline
