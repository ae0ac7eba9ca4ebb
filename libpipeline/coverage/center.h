#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/exact_rows.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {

/// The plane of a triangle whose coordinates are not all decimals, for its depths under the rule `center`. It
/// is calculated in pairs of doubles, with errors far below the depth's bound
/// (tests/proofs/depth_in_planes.g).
struct DepthPlane {
  DoubleDouble corner;  // the depth at the center of the pixel in row 0 and column 0
  DoubleDouble per_column;
  DoubleDouble per_row;
};

/// The triangle's plane; none if the depth's bound is not certain: for the narrowest triangles, extreme
/// numbers, and windows whose limits have many digits.
std::optional<DepthPlane> depth_plane(const ExactGrid& grid, const ExactTriangle& triangle);

/// The depth along a row of the triangle, as TriangleDepth::along().
SpanDepth depth_along(const DepthPlane& plane, int row, int first_column, int last_column);

/// The coverage rule `center` for one triangle: the pixels whose centers lie inside it. A center on an edge
/// belongs to the triangle only if that edge is a top or a left edge, so triangles that share edges own every
/// pixel once. Both windings are drawn alike; a triangle without area covers nothing. Decided exactly, for
/// any finite coordinates: in 64 bits where they suffice (nearly always), else in 128, or in as many as
/// needed. The depth is TriangleDepth's or DepthPlane's, within 2^-50 of the triangle's largest |z|.
class CenterRows {
 public:
  CenterRows(const ExactGrid& grid, const ExactTriangle& triangle);

  /// The rows that may have pixels, inside the screen; first_row() > last_row() if there are none.
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }

  /// The pixels that the triangle covers on `row`, inside the screen; none if it contains no center.
  [[nodiscard]] std::optional<Span> span(int row) const {
    if (const auto* const narrow = std::get_if<ExactRows<std::int64_t>>(&rows_)) return narrow->span(row);
    if (const auto* const medium = std::get_if<ExactRows<Int128>>(&rows_)) return medium->span(row);
    std::optional<Span> span = wide_span(row);
    if (span && plane_) span->depth = depth_along(*plane_, row, span->first_column, span->last_column);
    return span;
  }

 private:
  int first_row_ = 0;
  int last_row_ = -1;
  template <typename Int>
  using OnHeap = std::unique_ptr<const ExactRows<Int>>;
  std::variant<std::monostate, ExactRows<std::int64_t>, ExactRows<Int128>, OnHeap<DoublesInt>,
               OnHeap<WideInt>, OnHeap<HugeInt>>
      rows_;
  std::optional<DepthPlane> plane_;

  [[nodiscard]] std::optional<Span> wide_span(int row) const {
    if (const auto* const doubles = std::get_if<OnHeap<DoublesInt>>(&rows_)) return (*doubles)->span(row);
    if (const auto* const wide = std::get_if<OnHeap<WideInt>>(&rows_)) return (*wide)->span(row);
    return std::get<OnHeap<HugeInt>>(rows_)->span(row);
  }
};

}  // namespace pipeline
