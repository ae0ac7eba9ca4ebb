#pragma once

#include <array>
#include <cstddef>

#include "libpipeline/coverage/exact_grid.h"

namespace pipeline {

/// The pixels that a triangle can cover: the centers on the screen in its bounding box, without those on its
/// lower or right side.
struct CenterBox {
  template <typename Int>
  CenterBox(const GridTriangle<Int>& triangle, int rows, int columns);

  [[nodiscard]] bool is_empty() const { return first_row == end_row || first_column == end_column; }

  /// The vertices, by the first row at or below each; in any order where that is the same one, or off the
  /// screen.
  std::array<std::size_t, 3> from_top;
  int first_row;
  int middle_row;  // the first at or below the middle vertex
  int end_row;
  int first_column;
  int end_column;

 private:
  /// Branch-free: which of three corners comes first is unpredictable.
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

}  // namespace pipeline
