#pragma once

#include <span>
#include <string_view>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/kernel.h"
#include "libpipeline/coverage/nearest.h"
#include "libpipeline/coverage/type_list.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

// The coverage rules of a screen. A rule turns a triangle into rows of pixels: rows(triangle) has first_row()
// and last_row(), inside the screen, and span(row), a std::optional<Span>. A rule with a kernel for many
// triangles has spans(triangles, rows, begin), too, which writes the same spans as a CoverageKernel does. A
// visibility algorithm takes a rule as its template parameter `Coverage`; users choose one by kName and read
// kMeaning beside it. kUsesDecimals: whether a coordinate written as a decimal is that decimal, not its
// nearest double.

/// From the pixel nearest to the left end of a row to the one nearest to its right end.
struct NearestCoverage {
  static constexpr std::string_view
      kName = "nearest",
      kMeaning = "on each row from the pixel nearest to its left end to that nearest to its right end";
  static constexpr bool kUsesDecimals = false;
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
  static constexpr std::string_view kName = "center",
                                    kMeaning = "those whose centers lie inside, decided exactly";
  static constexpr bool kUsesDecimals = true;
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

/// Every coverage rule, in the order of --help; the first is the default.
using CoverageRules = TypeList<NearestCoverage, CenterCoverage>;

/// Writes the spans of many triangles by any rule, as a CoverageKernel does.
template <typename Coverage>
TaggedSpan* spans_by(const Coverage& rule, std::span<const TaggedTriangle> triangles, const RowRange& rows,
                     TaggedSpan* spans) {
  if constexpr (requires { rule.spans(triangles, rows, spans); }) return rule.spans(triangles, rows, spans);
  for (const auto& [triangle, tag] : triangles) spans = append_spans(rule.rows(triangle), tag, rows, spans);
  return spans;
}

}  // namespace pipeline
