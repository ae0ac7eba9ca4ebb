#include "libpipeline/coverage/center.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <type_traits>

namespace pipeline {
namespace {

// Limits below the types' own by more than the rounding error of the bound.
constexpr double kMaxIn64Bits = 0x1p61;
[[maybe_unused]] constexpr double kMaxIn128Bits = 0x1p125;
constexpr int kMaxBitsOfCoordinate = 126;
constexpr int kBitsOfWideInt = 64 * 6;

}  // namespace

// Z5, Z5a
CenterRows::CenterRows(const ExactGrid& grid, const ExactTriangle& triangle) {
  const std::array<double, 3> z = {triangle.p_ndc[0].z, triangle.p_ndc[1].z, triangle.p_ndc[2].z};
  const int rows = grid.rows.count, columns = grid.columns.count;
  const auto set = [&](const auto& chosen) {
    first_row_ = chosen.first_row();
    last_row_ = chosen.last_row();
  };
  if (const auto narrow = narrow_triangle(grid, triangle)) {
    const CenterBox box(*narrow, rows, columns);
    if (box.is_empty()) return;
    const double largest = largest_product(*narrow, box);
    if (largest <= kMaxIn64Bits) {
      set(rows_.emplace<ExactRows<std::int64_t>>(*narrow, box, z));
      return;
    }
    // No coordinate in 64 bits is more than 2^60 away from the middle of the window.
    assert(largest <= kMaxIn128Bits);
    set(rows_.emplace<ExactRows<Int128>>(*narrow, box, z));
    return;
  }
  if (!triangle.is_decimal()) plane_ = depth_plane(grid, triangle);
  const AxisUnits x = column_units(grid, triangle), y = row_units(grid, triangle);
  const auto set_on_heap = [&]<typename Int, typename Coordinate = Int>(std::type_identity<Int>,
                                                                        std::type_identity<Coordinate> = {}) {
    const GridTriangle<Coordinate> on_grid = grid_triangle<Coordinate>(grid, x, y);
    const CenterBox box(on_grid, rows, columns);
    if (box.is_empty()) return;
    set(*rows_.emplace<OnHeap<Int>>(std::make_unique<const ExactRows<Int>>(on_grid, box, z)));
  };
  if (std::max(x.bits, y.bits) <= kMaxBitsOfCoordinate) {
    set_on_heap(std::type_identity<DoublesInt>{}, std::type_identity<Int128>{});
  } else if (x.bits + y.bits + 3 < kBitsOfWideInt) {
    set_on_heap(std::type_identity<WideInt>{});
  } else {
    set_on_heap(std::type_identity<HugeInt>{});
  }
}

}  // namespace pipeline
