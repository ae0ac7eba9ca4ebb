#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// A pixel of the screen; row 0 is at the top, column 0 on the left.
struct Pixel {
  int column = 0;
  int row = 0;

  friend bool operator==(const Pixel&, const Pixel&) = default;
};

/// The result of a fragment's depth test; those outside the depth limits come last.
enum class DepthTestResult {
  kept,
  behind,        // the visible fragment is nearer
  equal,         // the visible fragment is as near and came earlier
  too_close,     // nearer than the visible fragment, but by the depth epsilon at most
  before_front,  // nearer than the front limit
  beyond_rear    // not nearer than the rear limit
};

/// A triangle at a pixel.
struct Fragment {
  Pixel pixel;
  std::uint64_t triangle = 0;
  double depth = 0;  // NDC z as the depth format stores it; as calculated if outside the limits
  DepthTestResult result = DepthTestResult::kept;
  std::uint64_t winner = 0;  // the triangle that beat it, if it is behind, equal or too close

  friend bool operator==(const Fragment&, const Fragment&) = default;
};

/// "COLUMN,ROW: triangle N, depth Z: kept", or "lost, " and why; the depth reads back to the same double.
std::string to_text(const Fragment& fragment);

/// The depth test of the visibility algorithms, fragment by fragment, with the reason for each result.
class FragmentTest {
 public:
  /// The fragment visible at a pixel so far.
  struct Seen {
    double depth;  // as the format stores it
    std::uint64_t triangle;
  };

  FragmentTest(const PixelRules& rules, const Viewport& screen)
      : format_(rules, screen),
        front_(screen.front),
        rear_(format_.store(screen.rear)),
        epsilon_(rules.depth_epsilon) {}

  /// The value of a pixel that shows no triangle.
  [[nodiscard]] Seen nothing() const { return {rear_, 0}; }

  /// Tests the next triangle's fragment of depth z at a pixel and updates `seen`.
  Fragment judge(Seen& seen, const Pixel& pixel, std::uint64_t triangle, double z) const {
    const double stored = format_.store(z);
    if (z < front_) return {pixel, triangle, z, DepthTestResult::before_front, 0};
    if (!is_nearer(stored, rear_)) return {pixel, triangle, z, DepthTestResult::beyond_rear, 0};
    const double depth = format_.depth(stored);
    if (!is_nearer(stored, seen.depth))
      return {pixel, triangle, depth, seen.depth < stored ? DepthTestResult::behind : DepthTestResult::equal,
              seen.triangle};
    if (seen.depth < rear_ && epsilon_ > 0 && !(format_.depth(seen.depth) - depth > epsilon_))
      return {pixel, triangle, depth, DepthTestResult::too_close, seen.triangle};
    seen = {stored, triangle};
    return {pixel, triangle, depth, DepthTestResult::kept, 0};
  }

 private:
  AnyDepth format_;
  double front_;
  double rear_;
  double epsilon_;
};

/// Reports every fragment of the picture or of one pixel, by triangle in the order of the stream, and within
/// a triangle from the top left. Keeps a depth and a number per pixel.
class FragmentLog {
 public:
  FragmentLog(const PixelRules& rules, const Viewport& screen)
      : FragmentLog(rules, screen, screen.drawn_rows(), {0, screen.columns}) {}
  /// The log of one pixel of the screen.
  FragmentLog(const PixelRules& rules, const Viewport& screen, const Pixel& pixel)
      : FragmentLog(rules, screen, {pixel.row, pixel.row + 1}, {pixel.column, pixel.column + 1}) {}

  /// Calls `visit(fragment)` for every pixel of the log that the next triangle covers.
  template <typename Visitor>
  void add(const ExactTriangle& p_ndc, std::uint64_t triangle, Visitor&& visit) {
    const auto add_span = [&](const Span& span) {
      const auto row = seen_.row(span.row);
      const int end = std::min(span.last_column + 1, columns_.end);
      for (int column = std::max(span.first_column, columns_.first); column < end; ++column)
        visit(test_.judge(row[static_cast<std::size_t>(column - columns_.first)], {column, span.row},
                          triangle, span.depth(column)));
    };
    std::visit([&](const auto& rule) { for_each_span(rule.rows(p_ndc), seen_.row_range(), add_span); },
               coverage_);
  }
  /// Calls `visit(triangle)` for every pixel of the log that shows a triangle.
  template <typename Visitor>
  void for_each_seen(Visitor&& visit) const {
    for (int row = seen_.row_range().first; row < seen_.row_range().end; ++row)
      for (const FragmentTest::Seen& seen : seen_.row(row))
        if (seen.depth < test_.nothing().depth) visit(seen.triangle);
  }
  /// True if the triangle covers a pixel of the screen, in the log or not.
  [[nodiscard]] bool is_covering(const ExactTriangle& p_ndc) const {
    const auto covers = [&](const auto& rule) {
      const auto rows = rule.rows(p_ndc);
      for (int row = rows.first_row(); row <= rows.last_row(); ++row)
        if (rows.span(row)) return true;
      return false;
    };
    return std::visit(covers, coverage_);
  }

 private:
  FragmentLog(const PixelRules& rules, const Viewport& screen, const RowRange& rows, const RowRange& columns)
      : coverage_(CoverageRules::made(rules.coverage, screen)),
        test_(rules, screen),
        columns_(columns),
        seen_(rows, columns.end - columns.first, test_.nothing()) {}

  CoverageRules::Object coverage_;
  FragmentTest test_;
  RowRange columns_;
  Raster<FragmentTest::Seen> seen_;
};

}  // namespace pipeline
