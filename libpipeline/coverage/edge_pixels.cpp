#include "libpipeline/coverage/edge_pixels.h"

#include <algorithm>
#include <utility>

#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {
namespace {

/// The columns or the rows.
template <typename Int>
struct Axis {
  const std::array<Int, 3>& corners;
  const Divisor<Int>& step;
  RowRange range;
};

/// Adds the pixels of the edge that begins at the corner `from`.
template <typename Product, typename Int>
void add_edge(const GridTriangle<Int>& t, const Triangle& p_ndc, std::size_t from, const RowRange& columns,
              const RowRange& rows, int width, std::vector<EdgePixel>& pixels) {
  std::size_t low = from, high = (from + 1) % 3;
  const Product du = Product(t.u[high] - t.u[low]), dv = Product(t.v[high] - t.v[low]);
  if (du == 0 && dv == 0) return;
  const auto size = [](const Product& value) { return value < 0 ? -value : value; };
  const bool is_flat = size(du) * Product(t.row_step.value()) >= size(dv) * Product(t.column_step.value());
  // Both triangles at the edge begin at the same end.
  if ((is_flat ? du : dv) < 0) std::swap(low, high);
  const std::array<Axis<Int>, 2> axes = {{{t.u, t.column_step, columns}, {t.v, t.row_step, rows}}};
  const Axis<Int>&along = axes[is_flat ? 0 : 1], &across = axes[is_flat ? 1 : 0];
  const Product length = size(is_flat ? du : dv);
  const Product rise = Product(across.corners[high] - across.corners[low]);
  const Product start = Product(across.corners[low]) * length;
  // Twice the distances, so that half a step is whole.
  const Divisor<Product> step(2 * (Product(across.step.value()) * length));
  const Product reach = width * (Product(across.step.value()) * length);
  const int bits = bit_length(length);
  const auto [least, greatest] = std::minmax(p_ndc[low].z, p_ndc[high].z);
  const int first = along.step.quotient_rounded_up(along.corners[low], along.range.end);
  const int end = along.step.quotient_rounded_up(along.corners[high] + 1, along.range.end);
  for (int i = std::max(first, along.range.first); i < end; ++i) {
    const Product way = Product(i * along.step.value() - along.corners[low]);
    const double part = to_double(way, bits) / to_double(length, bits);
    const double depth = std::clamp((1 - part) * p_ndc[low].z + part * p_ndc[high].z, least, greatest);
    const Product crossing = 2 * (start + way * rise);
    const int first_across = step.quotient_rounded_up(crossing - reach, across.range.end);
    const int end_across = step.quotient_rounded_up(crossing + reach, across.range.end);
    for (int k = std::max(first_across, across.range.first); k < end_across; ++k)
      pixels.push_back({is_flat ? k : i, is_flat ? i : k, depth, from});
  }
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
