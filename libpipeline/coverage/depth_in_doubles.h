#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/double_double.h"

namespace pipeline {

/// TriangleDepth for weights that are whole numbers and fit in a double, as they nearly always do.
///
/// The depth is the weighted mean of the three depths, within the bound of tests/proofs/depth_in_doubles.g of
/// the exact one.
class DepthInDoubles {
 public:
  static constexpr std::int64_t kMaxWeight = std::int64_t{1} << 50;
  /// While the largest |z| lies between these, no product with a weight overflows, and the underflow of a
  /// smaller one is negligible.
  static constexpr double kMinDepth = 0x1p-900, kMaxDepth = 0x1p900;

  /// Turns -0 into 0, so that the sign of a zero does not depend on the signs of the weights, nor on zeros
  /// among them.
  static constexpr double kNoMinus = 0;

  /// True if these depths and weights, those of a TriangleDepth, are in range.
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

}  // namespace pipeline
