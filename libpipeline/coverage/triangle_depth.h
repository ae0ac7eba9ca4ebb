#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <type_traits>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/fixed_int.h"

namespace pipeline {

/// TriangleDepth for weights that are whole numbers and fit in a double, as nearly all do.
///
/// The depth is the weighted mean of the three depths, within the bound of tests/proofs/depth_in_doubles.g of
/// the exact one.
class DepthInDoubles {
 public:
  static constexpr std::int64_t kMaxWeight = std::int64_t{1} << 50;
  /// If the largest |z| lies between these, no product with a weight overflows, and the underflow of one is
  /// negligible.
  static constexpr double kMinDepth = 0x1p-900, kMaxDepth = 0x1p900;

  /// Added, turns -0 into 0, so that a zero's sign does not depend on the weights' signs or on zeros among
  /// them.
  static constexpr double kNoMinus = 0;

  /// True if these depths and weights of a TriangleDepth are in range.
  static bool can_take(const std::array<double, 3>& z, std::int64_t total, std::int64_t b_step,
                       std::int64_t c_step) {
    const double size = std::max({std::fabs(z[0]), std::fabs(z[1]), std::fabs(z[2])});
    return std::max({total, std::abs(b_step), std::abs(c_step)}) <= kMaxWeight &&
           (is_flat(z) || (kMinDepth <= size && size <= kMaxDepth));
  }

  DepthInDoubles(const std::array<double, 3>& z, double total, double b_step, double c_step)
      : z_(z), twice_total_(2 * total), is_flat_(is_flat(z)) {
    if (is_flat_) return;
    const DoubleDouble of_two = two_sum(b_step * z[1], c_step * z[2]);
    const DoubleDouble of_three = two_sum(of_two.hi, (-b_step - c_step) * z[0]);
    half_slope_ = (of_three.hi + (of_two.lo + of_three.lo)) / twice_total_ + kNoMinus;
  }

  /// See TriangleDepth::along().
  [[nodiscard]] SpanDepth along(int first_column, int last_column, double twice_b, double twice_c) const {
    const double twice_a = twice_total_ - twice_b - twice_c;
    const double mean = ((twice_b * z_[1] + twice_c * z_[2]) + twice_a * z_[0]) / twice_total_ + kNoMinus;
    return {0, 2, static_cast<double>(first_column + last_column), is_flat_ ? z_[0] : mean, half_slope_};
  }

 private:
  static bool is_flat(const std::array<double, 3>& z) { return z[0] == z[1] && z[0] == z[2]; }

  std::array<double, 3> z_;  // of a, b and c
  double twice_total_;
  double half_slope_ = 0;  // per half column
  bool is_flat_;
};

/// The depth over a triangle a, b, c, from the exact weights of its vertices. A vertex's weight at a point is
/// twice the area of the triangle of the point and the other two vertices: at least 0 inside; the three
/// weights add up to `total`.
/// For Z the largest |z| of the three, the depth at a pixel inside is within 2^-50 Z of the exact one (while
/// Z is at least 1e-288), and a triangle of one depth has exactly that depth everywhere. If the depths are
/// taken as the decimals next to the doubles, this adds at most another 2^-53 Z.
/// If doubles hold the weights, the depth comes from DepthInDoubles. Otherwise depths become whole numbers of
/// 61 bits, so that the depth in the middle of a span and the slope per half column are exact sums of
/// products, divided by the total: tests/proofs/depth_in_wide_integers.g.
class TriangleDepth {
 public:
  TriangleDepth() = default;
  /// `z` are the depths of a, b and c, `total` is above 0, and `b_step` and `c_step` are the growth of the
  /// weights of b and c from one column to the next.
  template <typename Int>
  TriangleDepth(const std::array<double, 3>& z, const Int& total, const Int& b_step, const Int& c_step);

  /// The depth along the pixels from `first_column` to `last_column` of a row, all in the triangle. `twice_b`
  /// and `twice_c` are the sums of the weights of b and c at the first and the last pixel.
  template <typename Int>
  [[nodiscard]] SpanDepth along(int first_column, int last_column, const Int& twice_b,
                                const Int& twice_c) const {
    if constexpr (std::is_same_v<Int, std::int64_t>)
      if (in_doubles_)
        return in_doubles_->along(first_column, last_column, static_cast<double>(twice_b),
                                  static_cast<double>(twice_c));
    const Int128 sum = a_sum_ + Int128{cut(twice_b, weight_shift_)} * b_rise_ +
                       Int128{cut(twice_c, weight_shift_)} * c_rise_;
    const double middle = flat_depth_ + to_double(sum) * inverse_ * unit_;
    // Columns are counted by halves, so that the middle is whole.
    return {0, 2, static_cast<double>(first_column + last_column), middle, half_slope_};
  }

 private:
  static constexpr int kWeightBits = 60;

  static int bits_to_cut(std::int64_t) { return 0; }
  template <typename Int>
  static int bits_to_cut(const Int& weight) {
    return std::max(0, bit_length(weight) - kWeightBits);
  }
  void set_depths(const std::array<double, 3>& z, std::int64_t total);
  void set_slope(std::int64_t b_step, std::int64_t c_step, double total);

  std::optional<DepthInDoubles> in_doubles_;  // if set, all else is unused
  int weight_shift_ = 0;                      // the count of low bits cut off the weights
  double inverse_ = 0;                        // 1 / (2 * total weight)
  double flat_depth_ = 0;    // if all depths are equal: then all members below are 0, else this is 0
  double half_slope_ = 0;    // per half column
  double unit_ = 0;          // depths are whole multiples of this
  Int128 a_sum_ = 0;         // twice the total weight times the depth of a
  std::int64_t b_rise_ = 0;  // from the depth of a to the depth of b
  std::int64_t c_rise_ = 0;  // and to the depth of c
};

template <typename Int>
TriangleDepth::TriangleDepth(const std::array<double, 3>& z, const Int& total, const Int& b_step,
                             const Int& c_step)
    : weight_shift_(bits_to_cut(total)) {
  if constexpr (std::is_same_v<Int, std::int64_t>)
    if (DepthInDoubles::can_take(z, total, b_step, c_step)) {
      in_doubles_.emplace(z, static_cast<double>(total), static_cast<double>(b_step),
                          static_cast<double>(c_step));
      return;
    }
  set_depths(z, cut(total, weight_shift_));
  const int shift = std::max(bits_to_cut(b_step), bits_to_cut(c_step));
  // The quotient is below 1 only if a step exceeds the total: then no row has two pixels, and no slope is
  // needed.
  set_slope(cut(b_step, shift), cut(c_step, shift), std::max(to_double(total, shift), 1.0));
}

}  // namespace pipeline
