#include "libpipeline/coverage/edge_pixels.h"

#include <algorithm>

#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {
namespace {

/// The rows or the columns, with the corners' distances from the first one.
template <typename Int>
struct Axis {
  const std::array<Int, 3>& corners;
  const Divisor<Int>& step;
  RowRange range;
};

template <typename Product>
Product size(const Product& value) {
  return value < 0 ? -value : value;
}

/// Calls `visit(i, k, t)` for each pixel, i counted along the edge and k across it. The pixel lies at the
/// fraction t of the way from the end `low` to the end `high`.
template <typename Product, typename Int, typename Visitor>
void for_each_on_edge(const Axis<Int>& along, const Axis<Int>& across, std::size_t low, std::size_t high,
                      int width, Visitor&& visit) {
  const Product length = Product(along.corners[high] - along.corners[low]);
  const Product rise = Product(across.corners[high] - across.corners[low]);
  const Product start = Product(across.corners[low]) * length;
  // Twice the distances, so that half a step is whole.
  const Divisor<Product> step(2 * (Product(across.step.value()) * length));
  const Product reach = width * (Product(across.step.value()) * length);
  const int bits = bit_length(length);
  const int first = along.step.quotient_rounded_up(along.corners[low], along.range.end);
  const int end = along.step.quotient_rounded_up(along.corners[high] + 1, along.range.end);
  for (int i = std::max(first, along.range.first); i < end; ++i) {
    const Product way = Product(i * along.step.value() - along.corners[low]);
    const Product crossing = 2 * (start + way * rise);
    const int first_across = step.quotient_rounded_up(crossing - reach, across.range.end);
    const int end_across = step.quotient_rounded_up(crossing + reach, across.range.end);
    const double t = to_double(way, bits) / to_double(length, bits);
    for (int k = std::max(first_across, across.range.first); k < end_across; ++k) visit(i, k, t);
  }
}

double depth_between(double z_low, double z_high, double t) {
  const auto [least, greatest] = std::minmax(z_low, z_high);
  return std::clamp((1 - t) * z_low + t * z_high, least, greatest);
}

template <typename Product, typename Int>
void add_edge(const GridTriangle<Int>& t, const Triangle& p_ndc, std::size_t from, const RowRange& columns,
              const RowRange& rows, int width, std::vector<EdgePixel>& pixels) {
  const std::size_t to = (from + 1) % 3;
  const Product du = Product(t.u[to] - t.u[from]), dv = Product(t.v[to] - t.v[from]);
  if (du == 0 && dv == 0) return;
  const Axis<Int> across_columns = {t.u, t.column_step, columns}, across_rows = {t.v, t.row_step, rows};
  const bool is_flat = size(du) * Product(t.row_step.value()) >= size(dv) * Product(t.column_step.value());
  // Both triangles at the edge begin at the same end.
  const bool is_rising = is_flat ? du > 0 : dv > 0;
  const std::size_t low = is_rising ? from : to, high = is_rising ? to : from;
  const auto depth = [&](double part) { return depth_between(p_ndc[low].z, p_ndc[high].z, part); };
  if (is_flat)
    for_each_on_edge<Product>(across_columns, across_rows, low, high, width, [&](int i, int k, double part) {
      pixels.push_back({k, i, depth(part)});
    });
  else
    for_each_on_edge<Product>(across_rows, across_columns, low, high, width, [&](int i, int k, double part) {
      pixels.push_back({i, k, depth(part)});
    });
}

}  // namespace

// T24a
void add_edge_pixels(const ExactGrid& grid, const ExactTriangle& triangle,
                     const std::array<bool, 3>& is_drawn, int samples_per_pixel, const RowRange& rows,
                     std::vector<EdgePixel>& pixels) {
  const RowRange columns = {0, grid.columns.count};
  const auto add = [&]<typename Product>(const auto& on_grid, Product) {
    for (std::size_t i = 0; i < 3; ++i)
      if (is_drawn[i])
        add_edge<Product>(on_grid, triangle.p_ndc, i, columns, rows, samples_per_pixel, pixels);
  };
  // Int128 holds products of three numbers of at most 61 bits, one of them a distance within the screen.
  if (const auto narrow = narrow_triangle(grid, triangle)) return add(*narrow, Int128());
  const AxisUnits x = column_units(grid, triangle), y = row_units(grid, triangle);
  if (x.bits + y.bits + 8 < static_cast<int>(8 * sizeof(WideInt)))
    add(grid_triangle<WideInt>(grid, x, y), WideInt());
  else
    add(grid_triangle<HugeInt>(grid, x, y), HugeInt());
}

}  // namespace pipeline
