#pragma once

#include "libpipeline/config.h"
#include "libpipeline/coverage_center.h"
#include "libpipeline/coverage_nearest.h"
#include "libpipeline/exact_grid.h"
#include "libpipeline/pixel_grid.h"

namespace pipeline {

// The coverage rules of a screen, each as what turns a triangle into rows of pixels: rows(triangle) has
// first_row() and last_row(), inside the screen, and span(row), a std::optional<Span>. A visibility algorithm
// takes one as its template parameter `Coverage`.

/// From the pixel nearest to the left end of a row to the one nearest to its right end.
struct NearestCoverage {
  using Rows = NearestRows;
  explicit NearestCoverage(const ScreenConfig& screen) : grid(screen) {}
  [[nodiscard]] Rows rows(const ExactTriangle& triangle) const { return {grid, triangle.p_ndc}; }

  PixelGrid grid;
};

/// The pixels whose centres lie in the triangle.
struct CenterCoverage {
  using Rows = CenterRows;
  explicit CenterCoverage(const ScreenConfig& screen) : grid(screen) {}
  [[nodiscard]] Rows rows(const ExactTriangle& triangle) const { return {grid, triangle}; }

  ExactGrid grid;
};

}  // namespace pipeline
