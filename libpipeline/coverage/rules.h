#pragma once

#include <span>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/kernel.h"
#include "libpipeline/coverage/nearest.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

// The coverage rules of a screen, each as what turns a triangle into rows of pixels: rows(triangle) has
// first_row() and last_row(), inside the screen, and span(row), a std::optional<Span>. spans(triangles, rows,
// begin) writes the same for many triangles, as a CoverageKernel does. A visibility algorithm takes a rule as
// its template parameter `Coverage`.

/// From the pixel nearest to the left end of a row to the one nearest to its right end.
struct NearestCoverage {
  using Rows = NearestRows;
  explicit NearestCoverage(const Viewport& screen) : grid(screen), kernel(coverage_kernel()) {}
  [[nodiscard]] Rows rows(const ExactTriangle& triangle) const { return {grid, triangle.p_ndc}; }
  TaggedSpan* spans(std::span<const TaggedTriangle> triangles, const RowRange& rows,
                    TaggedSpan* begin) const {
    return kernel.nearest_spans(grid, triangles, rows, begin);
  }

  PixelGrid grid;
  CoverageKernel kernel;
};

/// The pixels whose centers lie in the triangle.
struct CenterCoverage {
  using Rows = CenterRows;
  explicit CenterCoverage(const Viewport& screen) : grid(screen), kernel(coverage_kernel()) {}
  [[nodiscard]] Rows rows(const ExactTriangle& triangle) const { return {grid, triangle}; }
  TaggedSpan* spans(std::span<const TaggedTriangle> triangles, const RowRange& rows,
                    TaggedSpan* begin) const {
    return kernel.center_spans(grid, triangles, rows, begin);
  }

  ExactGrid grid;
  CoverageKernel kernel;
};

}  // namespace pipeline
