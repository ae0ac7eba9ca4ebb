#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "libpipeline/span.h"

namespace pipeline {

/// What TriangleDepth says, for weights that are whole numbers a double holds: nearly always.
///
/// It is the mean of the three depths, weighted: at most 7.5 u Z from the exact one, u = 2^-53 and Z the
/// largest |z|, where 2^-50 Z is 8 u Z. Weights are exact. In the middle of a span the depth m is off by u Z
/// for the three products (the weights of a point inside add up to the total), u Z for the first sum of two,
/// u|m| for the second and u|m| for the quotient. At h half columns from there the slope s, where |h| times
/// the growth of a weight is at most half of twice the total and all three together at most all of it, is off
/// by u Z / h for the products, u Z / (2 h) for a's term, to which what the first sum lost is added, u|s| for
/// the second sum and u|s| for the quotient; h s by another u|h s|; the sum of the two by u Z. |m| + |h s| is
/// at most Z, because the span's ends are in the triangle and are m + h s and m - h s.
class PlainDepth {
 public:
  static constexpr std::int64_t kLargestWeight = std::int64_t{1} << 50;
  /// No product with a weight leaves a double's range between these, and a depth below them is not missed.
  static constexpr double kSmallestDepth = 0x1p-900, kLargestDepth = 0x1p900;

  /// Makes 0 of -0, which only a weight of -0 could have brought about.
  static constexpr double kNoMinus = 0;

  /// Whether these depths and weights can be taken; they are what a TriangleDepth takes.
  static bool can_take(const std::array<double, 3>& z, std::int64_t total, std::int64_t b_step,
                       std::int64_t c_step) {
    const double size = std::max({std::fabs(z[0]), std::fabs(z[1]), std::fabs(z[2])});
    return std::max({total, std::abs(b_step), std::abs(c_step)}) <= kLargestWeight &&
           (is_flat(z) || (kSmallestDepth <= size && size <= kLargestDepth));
  }

  PlainDepth() = default;
  PlainDepth(const std::array<double, 3>& z, double total, double b_step, double c_step)
      : z_(z), twice_total_(2 * total), is_flat_(is_flat(z)) {
    if (is_flat_) return;
    const double b_rise = b_step * z[1], c_rise = c_step * z[2];
    const double sum = b_rise + c_rise;
    // What is lost in the sum, exactly (D. Knuth, The Art of Computer Programming 2, 4.2.2, theorem B).
    const double c_part = sum - b_rise;
    const double lost = (b_rise - (sum - c_part)) + (c_rise - c_part);
    half_slope_ = (sum + ((-b_step - c_step) * z[0] + lost)) / twice_total_ + kNoMinus;
  }

  /// As TriangleDepth::along().
  [[nodiscard]] SpanDepth along(int first_column, int last_column, double twice_b, double twice_c) const {
    const double twice_a = twice_total_ - twice_b - twice_c;
    const double mean = ((twice_b * z_[1] + twice_c * z_[2]) + twice_a * z_[0]) / twice_total_ + kNoMinus;
    return {0, 2, static_cast<double>(first_column + last_column), is_flat_ ? z_[0] : mean, half_slope_};
  }

 private:
  static bool is_flat(const std::array<double, 3>& z) { return z[0] == z[1] && z[0] == z[2]; }

  std::array<double, 3> z_{};  // of a, b and c
  double twice_total_ = 1;
  double half_slope_ = 0;  // per half column
  bool is_flat_ = true;
};

}  // namespace pipeline
