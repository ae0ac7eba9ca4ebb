#include "libpipeline/coverage/exact_grid.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>

#include "libpipeline/numbers/decimal_units.h"

namespace pipeline {
namespace {

// The product hi * 10^7 for n units is off by at most 2^-52 of n, so up to this limit n is the nearest whole
// number.
constexpr double kMaxRoundedUnits = 0x1p50;
constexpr double kMaxNarrow = 0x1p60;
constexpr double kMaxDecimal = 1e22;

std::int64_t nearest_int(double units) {
  return static_cast<std::int64_t>(nearest_whole(units));
}

/// The number with an odd mantissa (or 0).
BinaryNumber reduced(Int128 mantissa, int exponent) {
  const auto low = static_cast<std::uint64_t>(mantissa);
  const int zeros =
      low != 0 ? std::countr_zero(low) : 64 + std::countr_zero(static_cast<std::uint64_t>(mantissa >> 64));
  return mantissa == 0 ? BinaryNumber{} : BinaryNumber{mantissa >> zeros, exponent + zeros};
}

BinaryNumber binary_units(double value) {
  constexpr std::int64_t kHiddenBit = std::int64_t{1} << 52;
  const auto bits = std::bit_cast<std::uint64_t>(value);
  const auto fraction = static_cast<std::int64_t>(bits) & (kHiddenBit - 1);
  const auto biased = static_cast<int>(bits >> 52 & 0x7ff);
  // Subnormal numbers and 0 have no hidden bit, and the exponent of the smallest normal numbers.
  const std::int64_t size = fraction + (biased > 0 ? kHiddenBit : 0);
  return reduced(Int128{value < 0 ? -size : size} * kGridUnitsPerOne, std::max(biased, 1) - 1075);
}

/// The value in 2^-20 units, rounded down; below 2^126 for |value| <= 10^22.
Int128 fixed_point_units(double value) {
  constexpr int kFractionBits = 20;
  const BinaryNumber number = binary_units(value);
  const int shift = number.exponent + kFractionBits;
  if (shift >= 0) return number.mantissa << shift;
  return shift > -127 ? number.mantissa >> -shift : 0;
}

/// The whole number of units nearest to hi + lo.
Int128 decimal_units(double hi, double lo) {
  const double units = hi * kGridUnitsPerOne;
  if (std::fabs(units) <= kMaxRoundedUnits) return nearest_int(units);
  constexpr Int128 kOne = 1 << 20;
  return (fixed_point_units(hi) + fixed_point_units(lo) + kOne / 2) >> 20;
}

BinaryNumber exact_units(double value, double low_part, bool is_decimal) {
  const bool has_decimals = is_decimal && std::fabs(value) <= kMaxDecimal;
  return has_decimals ? reduced(decimal_units(value, low_part), 0) : binary_units(value);
}

int bits_of(const BinaryNumber& number) {
  return bit_length(number.mantissa) + number.exponent;
}

AxisUnits axis_units(const GridAxis& axis, const ExactTriangle& triangle, double Vec3::*coordinate,
                     unsigned mark) {
  AxisUnits result;
  int value_bits = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low_part = triangle.low_parts == nullptr ? 0 : (*triangle.low_parts)[i].*coordinate;
    const bool is_decimal = ((triangle.decimal_marks >> (3 * i + mark)) & 1u) != 0;
    result.units[i] = exact_units(triangle.p_ndc[i].*coordinate, low_part, is_decimal);
    result.twos = std::max(result.twos, -result.units[i].exponent);
    value_bits = std::max(value_bits, bits_of(result.units[i]));
  }
  // Two terms: a vertex's distance from the middle of the window, and up to 2^17 half steps to either side of
  // it (more if pixels are samples); two more bits hold their sum and the distance between two such points.
  const int window_bits = axis.half_step_bits + std::max(18, bit_length(Int128{axis.count}) + 2);
  result.bits = result.twos + std::max(value_bits + axis.vertex_factor_bits, window_bits) + 2;
  return result;
}

}  // namespace

GridAxis::GridAxis(int pixel_count, double limit, double limit_low_part, bool limit_is_decimal)
    : count(pixel_count) {
  assert(limit < 0);
  // vertex_factor / half_step = count / (10^7 |limit|), reduced.
  BinaryNumber size = exact_units(-limit, -limit_low_part, limit_is_decimal);
  assert(size.mantissa > 0);
  int factor = count / std::gcd(count, static_cast<int>(size.mantissa % count));
  size.mantissa /= count / factor;
  for (; size.exponent > 0 && factor % 2 == 0; factor /= 2) --size.exponent;
  vertex_factor = HugeInt(factor) << std::max(-size.exponent, 0);
  half_step = HugeInt(size.mantissa) << std::max(size.exponent, 0);
  origin = HugeInt(count - 1) * half_step;
  vertex_factor_bits = bit_length(vertex_factor);
  half_step_bits = bit_length(half_step);

  // 2^44 leaves room for a product with the pixels of any picture; if pixels are samples, there are more of
  // them.
  if (vertex_factor_bits > 44 || half_step_bits > std::min(44, 60 - bit_length(Int128{count}))) return;
  narrow_vertex_factor = cut(vertex_factor, 0);
  narrow_origin = cut(origin, 0);
  narrow_step = Divisor<std::int64_t>(2 * cut(half_step, 0));
  largest_narrow_units = std::min(kMaxRoundedUnits, kMaxNarrow / static_cast<double>(narrow_vertex_factor));

  in_doubles.count = count;
  in_doubles.step = static_cast<double>(narrow_step.value());
  in_doubles.inverse_step = 1 / in_doubles.step;
  in_doubles.vertex_factor = static_cast<double>(narrow_vertex_factor);
  pixels_per_unit = DoubleDouble{in_doubles.vertex_factor} / DoubleDouble{in_doubles.step};
  in_doubles.origin = static_cast<double>(narrow_origin);
  if (in_doubles.step * count <= kMaxExactDouble) in_doubles.largest = kMaxExactDouble - in_doubles.origin;
}

std::optional<GridTriangle<std::int64_t>> narrow_triangle(const ExactGrid& grid,
                                                          const ExactTriangle& triangle) {
  if (!triangle.is_decimal()) return std::nullopt;
  const GridAxis& columns = grid.columns;
  const GridAxis& rows = grid.rows;
  GridTriangle<std::int64_t> result{{}, {}, columns.narrow_step, rows.narrow_step};
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = triangle.p_ndc[i].x * kGridUnitsPerOne;
    const double y = triangle.p_ndc[i].y * kGridUnitsPerOne;
    const bool fits =
        (std::fabs(x) <= columns.largest_narrow_units) & (std::fabs(y) <= rows.largest_narrow_units);
    if (!fits) return std::nullopt;
    result.u[i] = columns.narrow_origin + nearest_int(x) * columns.narrow_vertex_factor;
    result.v[i] = rows.narrow_origin - nearest_int(y) * rows.narrow_vertex_factor;
  }
  return result;
}

AxisUnits column_units(const ExactGrid& grid, const ExactTriangle& triangle) {
  return axis_units(grid.columns, triangle, &Vec3::x, 0);
}

AxisUnits row_units(const ExactGrid& grid, const ExactTriangle& triangle) {
  return axis_units(grid.rows, triangle, &Vec3::y, 1);
}

}  // namespace pipeline
