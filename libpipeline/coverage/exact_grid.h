#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/fixed_int.h"
#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// Enough bits for products of coordinates of 126 bits each, as for --digits exact in pictures of
/// ordinary size.
using DoublesInt = FixedInt<4>;
/// Enough bits for all exact geometry in practice: other texts with more than 7 decimals (--digits exact),
/// vertices 10^30 pixels away, or coordinates of 10^-30 next to others of 1. In HugeInt, such triangles take
/// some 50 times as long.
using WideInt = FixedInt<6>;
/// Enough bits for any finite coordinates and limits: a coordinate on the grid has at most 2850 bits, a
/// product 5705.
using HugeInt = FixedInt<92>;

/// A triangle in NDC with the exact x and y of its text: a coordinate below 10^22 with its mark set (bit 3 *
/// vertex + axis) is the number with at most 7 decimals that is nearest to the double plus the low part; any
/// other is exactly its double.
struct ExactTriangle {
  /// True if every x and y is a decimal.
  [[nodiscard]] bool is_decimal() const {
    constexpr unsigned kMarksOfXAndY = 0b011'011'011;
    return (decimal_marks & kMarksOfXAndY) == kMarksOfXAndY;
  }

  const Triangle& p_ndc;
  const Triangle* low_parts = nullptr;  // null if all are 0
  std::uint16_t decimal_marks = 0;
};

/// A triangle to be drawn.
struct TaggedTriangle {
  ExactTriangle triangle;
  PixelTag tag;
};

/// A triangle on a grid of whole numbers: u to the right, v down, and the center of the pixel (row, column)
/// at u = column * column_step, v = row * row_step.
template <typename Int>
struct GridTriangle {
  std::array<Int, 3> u;
  std::array<Int, 3> v;
  Divisor<Int> column_step;
  Divisor<Int> row_step;
};

/// The exact number mantissa * 2^exponent.
struct BinaryNumber {
  Int128 mantissa = 0;
  int exponent = 0;
};

/// The units in 1: a coordinate n / 10^7 is n units.
constexpr std::int64_t kGridUnitsPerOne = 10'000'000;

/// The largest whole number calculated in doubles, with room for sums and for the rounding of a quotient.
constexpr double kMaxExactDouble = 0x1p50;

/// A GridAxis whose numbers are small, in doubles.
struct AxisInDoubles {
  double count = 0;  // of pixels
  double step = 1;   // from one pixel to the next
  double inverse_step = 1;
  double vertex_factor = 1;
  double origin = 0;
  /// A vertex's calculated distance from the center of pixel 0 is exact if its absolute value is at most
  /// this. Negative if the numbers are not small; the other members are then meaningless.
  double largest = -1;
};

/// One direction of the grid. Its unit is half a pixel / half_step: pixel centers are at (2 i + 1 - count) *
/// half_step from the window's middle, and n / 10^7 is at n * vertex_factor. In units finer by 2^k, centers
/// and all n / (10^7 * 2^k) are whole numbers.
struct GridAxis {
  /// `limit` is the window's left or bottom limit, negative, in the same notation as an ExactTriangle's
  /// coordinates.
  GridAxis(int pixel_count, double limit, double limit_low_part, bool limit_is_decimal);

  int count;  // of pixels
  HugeInt vertex_factor;
  HugeInt half_step;
  HugeInt origin;  // the distance from the center of pixel 0 to the middle
  int vertex_factor_bits = 0;
  int half_step_bits = 0;
  // The same numbers if they are small; 64 bits are then enough for decimals n / 10^7 with |n| <=
  // largest_narrow_units.
  double largest_narrow_units = -1;
  std::int64_t narrow_vertex_factor = 0;
  std::int64_t narrow_origin = 0;
  Divisor<std::int64_t> narrow_step;
  AxisInDoubles in_doubles;
  DoubleDouble pixels_per_unit = {std::numeric_limits<double>::quiet_NaN(), 0};  // within 2^-101
};

/// The coordinates of a triangle along one axis as exact numbers, and the grid that they need.
struct AxisUnits {
  std::array<BinaryNumber, 3> units;  // a coordinate n / 10^7 is n units
  int twos = 0;                       // all units are whole multiples of 2^-twos
  int bits = 0;                       // at least those of the largest number on the grid
};

/// The exact positions of a screen's pixel centers; PixelGrid rounds them.
struct ExactGrid {
  explicit ExactGrid(const Viewport& screen)
      : columns(screen.columns, screen.left, screen.left_low_part, screen.left_is_decimal),
        rows(screen.rows, screen.bottom, screen.bottom_low_part, screen.bottom_is_decimal) {}

  GridAxis columns;
  GridAxis rows;
};

/// The triangle in 64 bits, every |u| and |v| below 2^61. None unless every x and y is a decimal of usual
/// size.
std::optional<GridTriangle<std::int64_t>> narrow_triangle(const ExactGrid& grid,
                                                          const ExactTriangle& triangle);

AxisUnits column_units(const ExactGrid& grid, const ExactTriangle& triangle);
AxisUnits row_units(const ExactGrid& grid, const ExactTriangle& triangle);

/// The triangle in a type that has enough bits for it.
template <typename Int>
GridTriangle<Int> grid_triangle(const ExactGrid& grid, const AxisUnits& x, const AxisUnits& y) {
  const auto cut_to_size = [](const HugeInt& value) {
    if constexpr (std::is_same_v<Int, Int128>)
      return static_cast<Int128>(UInt128{value.limb(1)} << 64 | value.limb(0));
    else
      return Int(value);
  };
  const auto on_grid = [&](const BinaryNumber& number, const GridAxis& axis, int twos) {
    return (Int(number.mantissa) << (number.exponent + twos)) * cut_to_size(axis.vertex_factor);
  };
  const auto finer = [&](const HugeInt& value, int twos) { return Int(cut_to_size(value) << twos); };
  GridTriangle<Int> result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.u[i] = finer(grid.columns.origin, x.twos) + on_grid(x.units[i], grid.columns, x.twos);
    result.v[i] = finer(grid.rows.origin, y.twos) - on_grid(y.units[i], grid.rows, y.twos);
  }
  result.column_step = Divisor<Int>(finer(grid.columns.half_step, x.twos + 1));
  result.row_step = Divisor<Int>(finer(grid.rows.half_step, y.twos + 1));
  return result;
}

// The coverage rules for many triangles at a time. Each kernel is for one kind of processor; all make the
// spans of NearestRows and CenterRows, to the last bit.

/// Writes the spans of the triangles, one triangle after the other and row by row, within `rows`, and returns
/// the end of the last one. There must be room for one span per row and triangle; the room after the last
/// span may be overwritten.
using NearestSpans = TaggedSpan* (*)(const PixelGrid& grid, std::span<const TaggedTriangle> triangles,
                                     const RowRange& rows, TaggedSpan* spans);
using CenterSpans = TaggedSpan* (*)(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                                    const RowRange& rows, TaggedSpan* spans);

extern const KernelTable<NearestSpans> kNearestKernels;
extern const KernelTable<CenterSpans> kCenterKernels;

/// Writes the spans of one triangle likewise; `covered` has its rows by a coverage rule.
template <typename CoveredRows>
TaggedSpan* append_spans(const CoveredRows& covered, PixelTag tag, const RowRange& rows, TaggedSpan* spans) {
  for_each_span(covered, rows, [&](const Span& span) { *spans++ = {span, tag}; });
  return spans;
}

}  // namespace pipeline
