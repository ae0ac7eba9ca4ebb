#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/coverage/triangle_depth.h"
#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {

/// The pixels that a triangle can cover: the centers on the screen in its bounding box, but not on the box's
/// lower or right side.
struct CenterBox {
  template <typename Int>
  CenterBox(const GridTriangle<Int>& triangle, int rows, int columns);

  [[nodiscard]] bool is_empty() const { return first_row == end_row || first_column == end_column; }

  /// The vertices, sorted by the first row at or below each; in any order if these rows are equal or off the
  /// screen.
  std::array<std::size_t, 3> from_top;
  int first_row;
  int middle_row;  // the first row at or below the middle vertex
  int end_row;
  int first_column;
  int end_column;

 private:
  /// Sorts three numbers, branch-free: their order is unpredictable.
  static std::array<unsigned, 3> sorted(unsigned p, unsigned q, unsigned r) {
    const auto smaller = [](unsigned i, unsigned j) { return i < j ? i : j; };
    const auto larger = [](unsigned i, unsigned j) { return i < j ? j : i; };
    const unsigned low = smaller(p, q), high = larger(p, q);
    return {smaller(low, r), larger(low, smaller(high, r)), larger(high, r)};
  }
};

template <typename Int>
CenterBox::CenterBox(const GridTriangle<Int>& t, int rows, int columns) {
  // Rows are sorted together with their vertices.
  const auto row_and_vertex = [&](unsigned i) {
    return 4 * static_cast<unsigned>(t.row_step.quotient_rounded_up(t.v[i], rows)) + i;
  };
  const auto column = [&](unsigned i) {
    return static_cast<unsigned>(t.column_step.quotient_rounded_up(t.u[i], columns));
  };
  const auto by_row = sorted(row_and_vertex(0), row_and_vertex(1), row_and_vertex(2));
  from_top = {by_row[0] % 4, by_row[1] % 4, by_row[2] % 4};
  first_row = static_cast<int>(by_row[0] / 4);
  middle_row = static_cast<int>(by_row[1] / 4);
  end_row = static_cast<int>(by_row[2] / 4);
  const auto by_column = sorted(column(0), column(1), column(2));
  first_column = static_cast<int>(by_column[0]);
  end_column = static_cast<int>(by_column[2]);
}

/// The pixels whose centers lie in a triangle on the grid, exactly, row by row.
/// An edge crosses the rows from the first at or below its upper end (included) to the first at or below its
/// lower end (excluded); a row has the pixels from the first at or right of its left crossing (included) to
/// the first at or right of its right crossing (excluded). This is the entire top-left rule: two edges cross
/// each row, and a crossing is the same fraction for both triangles at the edge.
/// Crossings are kept as exact numerators over exact denominators. At a pixel, these numbers are edge
/// functions (J. Pineda, "A parallel algorithm for polygon rasterization", 1988), the weights of the
/// vertices. For an `Int` of limited size, largest_product() bounds them.
template <typename Int>
class ExactRows {
 public:
  /// The pixels of a triangle whose box is `box`, not empty; `z` has the depths of its vertices.
  template <typename Coordinate>
  ExactRows(const GridTriangle<Coordinate>& triangle, const CenterBox& box, const std::array<double, 3>& z);

  /// The rows to ask for, inside the screen; first_row() > last_row() if there are none.
  [[nodiscard]] int first_row() const { return first_row_; }
  [[nodiscard]] int last_row() const { return last_row_; }
  [[nodiscard]] std::optional<Span> span(int row) const;

 private:
  struct Edge {
    Int crossing;              // of first_row_: its distance from first_column_, times column_step
    Int row_step;              // the increase of `crossing` on the next row
    Divisor<Int> column_step;  // the increase for a crossing one column further right
  };
  template <typename Coordinate>
  [[nodiscard]] Edge edge(const GridTriangle<Coordinate>& t, std::size_t upper, std::size_t lower) const;

  int first_column_;
  int column_count_;
  int first_row_;
  int middle_row_;
  int last_row_;
  bool longest_is_left_;
  Int twice_total_;
  // For the vertices a, b, c from the top: ac crosses all rows, ab the rows above middle_row_, bc the others.
  std::array<Edge, 3> edges_;
  TriangleDepth depth_;
};

/// A bound on the numbers in an ExactRows of the triangle.
inline double largest_product(const GridTriangle<std::int64_t>& t, const CenterBox& box) {
  const auto [left, right] = std::minmax({t.u[0], t.u[1], t.u[2]});
  const auto [top, bottom] = std::minmax({t.v[0], t.v[1], t.v[2]});
  const std::int64_t first = box.first_column * t.column_step.value();
  // Vertices and the pixels they enclose are at most x away from the first column; vertices and rows are at
  // most y apart. The first crossing is the sum of a product below x y and one below 2 x y; the area is the
  // difference of two products below 2 x y; all other numbers are smaller.
  const double x =
      std::max(std::fabs(static_cast<double>(left - first)), std::fabs(static_cast<double>(right - first))) +
      2 * static_cast<double>(t.column_step.value());
  const double y = static_cast<double>(bottom - top) + static_cast<double>(t.row_step.value());
  return 4 * x * y;
}

template <typename Int>
template <typename Coordinate>
ExactRows<Int>::ExactRows(const GridTriangle<Coordinate>& t, const CenterBox& box,
                          const std::array<double, 3>& z)
    : first_column_(box.first_column),
      column_count_(box.end_column - box.first_column),
      first_row_(box.first_row),
      middle_row_(box.middle_row),
      last_row_(box.end_row - 1) {
  const auto [a, b, c] = box.from_top;
  // The weight of b at b: positive if b is right of ac.
  const Int weight = Int(t.u[b] - t.u[a]) * (t.v[c] - t.v[a]) - Int(t.v[b] - t.v[a]) * (t.u[c] - t.u[a]);
  if (weight == 0) {
    last_row_ = first_row_ - 1;
    return;
  }
  longest_is_left_ = weight > 0;
  edges_ = {edge(t, a, c), edge(t, a, b), edge(t, b, c)};

  const int sign = 2 * static_cast<int>(longest_is_left_) - 1;
  const Int total = sign * weight;
  twice_total_ = 2 * total;
  const Int signed_step = sign * t.column_step.value();
  depth_ = TriangleDepth({z[a], z[b], z[c]}, total, Int(signed_step * (t.v[c] - t.v[a])),
                         Int(signed_step * (t.v[a] - t.v[b])));
}

template <typename Int>
template <typename Coordinate>
typename ExactRows<Int>::Edge ExactRows<Int>::edge(const GridTriangle<Coordinate>& t, std::size_t upper,
                                                   std::size_t lower) const {
  const Int du = t.u[lower] - t.u[upper];
  const Int dv = t.v[lower] - t.v[upper];
  const Int upper_u = t.u[upper] - first_column_ * t.column_step.value();
  const Int below_upper = first_row_ * t.row_step.value() - t.v[upper];
  return {upper_u * dv + below_upper * du, Int(t.row_step.value()) * du,
          Divisor<Int>(Int(t.column_step.value()) * dv)};
}

template <typename Int>
std::optional<Span> ExactRows<Int>::span(int row) const {
  // Indices instead of conditions, because no processor can predict them.
  const std::size_t shorter = row < middle_row_ ? 1 : 2;
  const std::size_t right = shorter * static_cast<std::size_t>(longest_is_left_), left = shorter - right;
  const Edge& left_edge = edges_[left];
  const Edge& right_edge = edges_[right];
  const int row_count = row - first_row_;
  const Int left_crossing = left_edge.crossing + row_count * left_edge.row_step;
  const Int right_crossing = right_edge.crossing + row_count * right_edge.row_step;
  const int first = left_edge.column_step.quotient_rounded_up(left_crossing, column_count_);
  const int last = right_edge.column_step.quotient_rounded_up(right_crossing, column_count_) - 1;
  if (first > last) return std::nullopt;

  // The weights of the vertices b, c and a, each opposite to an edge: the sums of those at the first and the
  // last pixel.
  std::array<Int, 3> weights;
  weights[left] = (first + last) * left_edge.column_step.value() - 2 * left_crossing;
  weights[right] = 2 * right_crossing - (first + last) * right_edge.column_step.value();
  weights[3 - shorter] = twice_total_ - weights[left] - weights[right];
  const int first_column = first_column_ + first, last_column = first_column_ + last;
  return Span{row, first_column, last_column,
              depth_.along(first_column, last_column, weights[0], weights[1])};
}

}  // namespace pipeline
