#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/numbers/random_numbers.h"
#include "tests/visibility/visible_frames.h"

namespace pipeline {
namespace {

/// The ends of a triangle's rows in doubles, either by the textbook method, x at an edge's first scanline
/// and then x += dx, or with x calculated anew on every scanline.
class RoundedRows {
 public:
  enum class X { by_increments, anew };

  RoundedRows(const PixelGrid& grid, const Triangle& p_ndc, X x)
      : grid_(grid), x_(x), columns_(static_cast<std::size_t>(grid.rows)) {
    for (std::size_t i = 0; i < 3; ++i) add_edge(p_ndc[i], p_ndc[(i + 1) % 3]);
  }

  /// How many of the row's two ends differ from the span's.
  [[nodiscard]] int wrong_ends(const Span& span) const {
    const std::vector<double> found = ends(span.row);
    if (found.size() != 2) return 2;
    return static_cast<int>(found[0] != span.first_column) +
           static_cast<int>(found[1] != span.last_column + 1);
  }

  /// The first column and the one after the last, from two edges' crossings with the row.
  [[nodiscard]] std::vector<double> ends(int row) const {
    std::vector<double> ends = columns_[static_cast<std::size_t>(row)];
    std::sort(ends.begin(), ends.end());
    for (double& end : ends) end = std::clamp(std::ceil(end), 0.0, 1.0 * grid_.columns);
    return ends;
  }
  void add_edge(Vec3 upper, Vec3 lower) {
    if (upper.y < lower.y) std::swap(upper, lower);
    const auto first_row_below = [&](double y) {
      return static_cast<int>(std::clamp(std::ceil((grid_.top_y - y) / grid_.dy), 0.0, 1.0 * grid_.rows));
    };
    const double slope = (lower.x - upper.x) / (lower.y - upper.y);
    const int first_row = first_row_below(upper.y), end_row = first_row_below(lower.y);
    const auto column_at = [&](int row) {
      return (upper.x + (grid_.y_of(row) - upper.y) * slope - grid_.left_x) / grid_.dx;
    };
    double column = column_at(first_row);
    for (int row = first_row; row < end_row; ++row, column -= slope * grid_.dy / grid_.dx)
      columns_[static_cast<std::size_t>(row)].push_back(x_ == X::anew ? column_at(row) : column);
  }

  PixelGrid grid_;
  X x_;
  std::vector<std::vector<double>> columns_;
};

TEST(Scanline, IncrementalXWouldGiveOtherColumns) {
  // Vertices with two decimals, as people write them, on 1000 rows.
  Viewport screen = {1000, 1000, -1, -1, -1, 1};
  screen.left_is_decimal = screen.bottom_is_decimal = true;
  const CenterCoverage exact(screen);
  RandomNumbers random(1);
  int end_count = 0, wrong_by_increments = 0, wrong_anew = 0;
  for (int i = 0; i < 1000; ++i) {
    Triangle triangle;
    for (Vec3& p : triangle) p = {random.whole(-100, 100) / 100.0, random.whole(-100, 100) / 100.0, 0};
    const RoundedRows by_increments(PixelGrid(screen), triangle, RoundedRows::X::by_increments);
    const RoundedRows anew(PixelGrid(screen), triangle, RoundedRows::X::anew);
    for_each_span(exact.rows({triangle, nullptr, kAllDecimals}), [&](const Span& span) {
      end_count += 2;
      wrong_by_increments += by_increments.wrong_ends(span);
      wrong_anew += anew.wrong_ends(span);
    });
  }
  EXPECT_EQ(end_count, 1020230);
  EXPECT_EQ(wrong_by_increments, 6816);
  EXPECT_EQ(wrong_anew, 4028);
}

}  // namespace
}  // namespace pipeline
