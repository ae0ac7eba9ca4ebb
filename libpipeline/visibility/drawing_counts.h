#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/raster.h"
#include "libpipeline/visibility/unseen.h"

namespace pipeline {

/// The fate of a picture's triangles. Every triangle is counted once: as seen, as hidden, or by the reason
/// why it would show nowhere.
struct DrawingCounts {
  UnseenPlaces unseen;
  std::uint64_t triangles = 0;
  std::uint64_t seen = 0;              // triangles that own a pixel of the complete picture
  std::uint64_t hidden = 0;            // triangles that own none, but would if they were alone
  std::uint64_t outside_rows = 0;      // triangles that cover pixels, but none in the drawn rows
  std::uint64_t pixels_written = 0;    // pixels that show a triangle
  std::uint64_t fragments_tested = 0;  // the sum of the pixels that each triangle covers
  BoundingBox extent;                  // in NDC
};

/// Counts by drawing the triangles of a stream once more, pixel by pixel and in order, so that no count
/// depends on the visibility algorithm, its kernels or its threads. Keeps a depth and a number per pixel.
class DrawingCounter {
 public:
  DrawingCounter(const PixelRules& rules, const Viewport& screen)
      : screen_(screen),
        coverage_(rules, screen),
        test_(rules, screen),
        visible_(screen.drawn_rows(), screen.columns, test_.nothing()) {}

  void add(const TriangleBatch& p_ndc) {
    for (std::size_t i = 0; i < p_ndc.size(); ++i) add(exact_triangle(p_ndc, i));
  }

  /// The counts for the triangles so far.
  [[nodiscard]] DrawingCounts counts() const {
    DrawingCounts counts = counts_;
    std::vector<bool> is_seen(static_cast<std::size_t>(counts.triangles));
    for (int row = visible_.row_range().first; row < visible_.row_range().end; ++row) {
      for (const auto& pixel : visible_.row(row)) {
        if (!(pixel.depth < test_.nothing().depth)) continue;
        ++counts.pixels_written;
        is_seen[static_cast<std::size_t>(pixel.triangle)] = true;
      }
    }
    for (const bool seen : is_seen) counts.seen += seen ? 1 : 0;
    counts.hidden -= counts.seen;
    return counts;
  }

 private:
  void add(const ExactTriangle& triangle) {
    FragmentDepths found;
    bool is_in_other_rows = false;
    const auto add_span = [&](const Span& span) {
      const RowRange& drawn = visible_.row_range();
      if (drawn.first <= span.row && span.row < drawn.end)
        add(span, found);
      else
        is_in_other_rows = true;
    };
    coverage_.visit([&](const auto& rule) { for_each_span(rule.rows(triangle), add_span); });
    const BoundingBox extent(triangle.p_ndc);
    counts_.extent.add(extent);
    ++counts_.triangles;
    if (found.visible)
      ++counts_.hidden;  // or seen, which only the complete picture shows
    else if (is_in_other_rows && !found.before_front && !found.beyond_rear)
      ++counts_.outside_rows;
    else
      counts_.unseen.add(unseen_place(triangle.p_ndc, extent, found, screen_), extent);
  }

  void add(const Span& span, FragmentDepths& found) {
    for (int column = span.first_column; column <= span.last_column; ++column) {
      auto& seen = visible_.row(span.row)[static_cast<std::size_t>(column)];
      const DepthTestResult result =
          test_.judge(seen, {column, span.row}, counts_.triangles, span.depth(column)).result;
      ++counts_.fragments_tested;
      if (result == DepthTestResult::before_front)
        found.before_front = true;
      else if (result == DepthTestResult::beyond_rear)
        found.beyond_rear = true;
      else
        found.visible = true;
    }
  }

  Viewport screen_;
  AnyCoverage coverage_;
  FragmentTest test_;
  Raster<FragmentTest::Seen> visible_;  // `triangle` is the index in the stream
  DrawingCounts counts_;
};

}  // namespace pipeline
