#pragma once

#include <algorithm>
#include <cstdint>

#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The first column in [first, end) for which `is_true` holds, or `end`, by bisection: the predicate must
/// hold for all columns after the first one for which it does.
template <typename Predicate>
int first_column_where(int first, int end, Predicate&& is_true) {
  while (first < end) {
    const int middle = first + (end - first) / 2;
    if (is_true(middle))
      end = middle;
    else
      first = middle + 1;
  }
  return first;
}

/// A triangle's depth along one row, a linear function of the column. Evaluated anew for every pixel: adding
/// a difference per column would drift.
struct SpanDepth {
  /// The depth (NDC z) at the center of the pixel in `column`. Finite members give a finite or infinite
  /// depth, never NaN; only finite depths can be seen.
  [[nodiscard]] double operator()(int column) const { return z0 + (left_x + column * dx - x0) * slope; }

  double left_x;  // x of the center of column 0
  double dx;      // width of a pixel
  double x0;      // a point where the depth is known ...
  double z0;      // ... and that depth
  double slope;   // dz/dx
};

/// A run of adjacent pixels in one row, covered by one triangle; coverage rules pass spans to visibility
/// algorithms.
struct Span {
  int row;
  int first_column;
  int last_column;  // included, not less than first_column
  SpanDepth depth;
};

/// The 32 bits kept for a triangle at every pixel that shows it; the caller gives them a meaning: the RGB
/// value of a color, or the number of a surface.
using PixelTag = std::uint32_t;

/// A span to be drawn.
struct TaggedSpan {
  Span span;
  PixelTag tag;
};

/// Calls `visit(span)` for every row of `range` that a triangle covers, from the top. `rows` come from a
/// coverage rule: first_row() and last_row(), inside the screen, and span(row), a std::optional<Span>.
template <typename CoveredRows, typename Visitor>
void for_each_span(const CoveredRows& rows, const RowRange& range, Visitor&& visit) {
  const int end = std::min(rows.last_row() + 1, range.end);
  for (int row = std::max(rows.first_row(), range.first); row < end; ++row)
    if (const auto span = rows.span(row)) visit(*span);
}

template <typename CoveredRows, typename Visitor>
void for_each_span(const CoveredRows& rows, Visitor&& visit) {
  for_each_span(rows, RowRange(), visit);
}

}  // namespace pipeline
