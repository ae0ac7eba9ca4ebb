#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "libpipeline/numbers/exact_sum.h"

namespace pipeline {
namespace {

/// The sum of `z`, weighted by the weights of the vertices at (x, y): a determinant.
Ball weighted_sum(const Triangle& p, double x, double y, const std::array<double, 3>& z) {
  std::vector<ExactProduct> terms;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &b = p[(i + 1) % 3], &c = p[(i + 2) % 3];
    for (const auto& [factor, other] : {std::pair(b.x, c.y), std::pair(-c.x, b.y), std::pair(x, b.y),
                                        std::pair(-x, c.y), std::pair(y, c.x), std::pair(-y, b.x)})
      terms.push_back({factor, other, z[i]});
  }
  return exact_sum(terms);
}

/// The smallest z where an edge meets the line at y.
Ball least_on_edges(const Triangle& p, double y) {
  std::optional<Ball> least;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &a = p[i], &b = p[(i + 1) % 3];
    if (a.y == b.y || y < std::min(a.y, b.y) || y > std::max(a.y, b.y)) continue;
    const Ball z =
        exact_sum({{a.z, b.y}, {-a.z, y}, {b.z, y}, {-b.z, a.y}}) / exact_sum({{b.y, 1}, {-a.y, 1}});
    if (!least || (z - *least).sign() < 0) least = z;
  }
  return *least;
}

template <typename Int>
Ball depth_on_grid(const GridTriangle<Int>& t, const Triangle& p, int row, int column) {
  const Int u = column * t.column_step.value(), v = row * t.row_step.value();
  Ball sum, total;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const Ball weight = to_ball(Int((t.u[j] - u) * (t.v[k] - v) - (t.v[j] - v) * (t.u[k] - u)), 0);
    sum = sum + weight * Ball(p[i].z);
    total = total + weight;
  }
  return sum / total;
}

}  // namespace

// Z4
Ball NearestRows::exact_depth(int row, int column) const {
  const double x = grid_.x_of(column), y = grid_.y_of(row);
  const Ends both = *ends(y);
  const Ball total = weighted_sum(p_, x, y, {1, 1, 1});
  if (!slope_ || both.left.x == both.right.x || total.sign() == 0) return least_on_edges(p_, y);
  return weighted_sum(p_, x, y, {p_[0].z, p_[1].z, p_[2].z}) / total;
}

Ball NearestCoverage::exact_depth(const ExactTriangle& triangle, int row, int column) const {
  return NearestRows(grid, triangle.p_ndc).exact_depth(row, column);
}

// Z7
Ball CenterCoverage::exact_depth(const ExactTriangle& triangle, int row, int column) const {
  const AxisUnits x = column_units(grid, triangle), y = row_units(grid, triangle);
  if (x.bits + y.bits + 3 < static_cast<int>(8 * sizeof(WideInt)))
    return depth_on_grid(grid_triangle<WideInt>(grid, x, y), triangle.p_ndc, row, column);
  return depth_on_grid(grid_triangle<HugeInt>(grid, x, y), triangle.p_ndc, row, column);
}

}  // namespace pipeline
