#pragma once

#include <span>
#include <string_view>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/nearest.h"
#include "libpipeline/coverage/type_list.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

// The coverage rules of a screen. A visibility algorithm takes a rule as its template parameter `Coverage`. A
// rule has
//   kName, kMeaning   the word that chooses it, and its line in --help;
//   kUsesDecimals     true if a coordinate written as a decimal is that decimal, not its nearest double;
//   rows(triangle)    the triangle's pixels: first_row() and last_row(), inside the screen, and span(row), a
//                     std::optional<Span>. Only a row whose line of pixel centers meets the triangle has any:
//                     bands and buffers are chosen by the triangle's height;
//   exact_depth(triangle, row, column)   the depth (NDC z) at a covered pixel, within 2^-97 of its own or the
//                     vertices' largest |z|, whichever is larger. Slow: for digits that a Span may lack;
//   spans(triangles, rows, begin)   writes the same spans of many triangles, by a kernel (exact_grid.h).

/// On each row, the pixels from the nearest to the triangle's left end to the nearest to its right end.
struct NearestCoverage {
  static constexpr std::string_view
      kName = "nearest",
      kMeaning = "on each row, from the pixel nearest its left end to the one nearest its right end";
  static constexpr bool kUsesDecimals = false;
  using Rows = NearestRows;
  explicit NearestCoverage(const Viewport& screen) : grid(screen), kernel(chosen_kernel(kNearestKernels)) {}
  [[nodiscard]] Rows rows(const ExactTriangle& triangle) const { return {grid, triangle.p_ndc}; }
  [[nodiscard]] Ball exact_depth(const ExactTriangle& triangle, int row, int column) const;
  TaggedSpan* spans(std::span<const TaggedTriangle> triangles, const RowRange& rows,
                    TaggedSpan* begin) const {
    return kernel(grid, triangles, rows, begin);
  }

  PixelGrid grid;
  NearestSpans kernel;
};

/// The pixels whose centers lie in the triangle.
struct CenterCoverage {
  static constexpr std::string_view kName = "center",
                                    kMeaning = "those whose centers lie inside, decided exactly";
  static constexpr bool kUsesDecimals = true;
  using Rows = CenterRows;
  explicit CenterCoverage(const Viewport& screen) : grid(screen), kernel(chosen_kernel(kCenterKernels)) {}
  [[nodiscard]] Rows rows(const ExactTriangle& triangle) const { return {grid, triangle}; }
  [[nodiscard]] Ball exact_depth(const ExactTriangle& triangle, int row, int column) const;
  TaggedSpan* spans(std::span<const TaggedTriangle> triangles, const RowRange& rows,
                    TaggedSpan* begin) const {
    return kernel(grid, triangles, rows, begin);
  }

  ExactGrid grid;
  CenterSpans kernel;
};

/// Every coverage rule, in the order of --help; the first is the default.
using CoverageRules = TypeList<NearestCoverage, CenterCoverage>;

}  // namespace pipeline
