#include "libpipeline/coverage/triangle_depth.h"

#include <bit>
#include <cmath>
#include <limits>

namespace pipeline {
namespace {

constexpr int kDepthBits = 61;
// The exponent of the smallest unit that is, like its inverse, a normal double.
constexpr int kMinUnit = -1020;

/// The exponent of the unit in which a number of this size has kDepthBits bits.
int unit_exponent(double size) {
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(size) >> 52) - 1023;
  return std::max(exponent - (kDepthBits - 1), kMinUnit);
}

}  // namespace

// Z7
void TriangleDepth::set_depths(const std::array<double, 3>& z, std::int64_t total) {
  inverse_ = 1 / static_cast<double>(2 * total);
  if (z[0] == z[1] && z[0] == z[2]) {
    flat_depth_ = z[0];
    return;
  }
  const int exponent = unit_exponent(std::max({std::fabs(z[0]), std::fabs(z[1]), std::fabs(z[2])}));
  unit_ = power_of_two(exponent);
  const double per_unit = power_of_two(-exponent);
  const auto a_depth = static_cast<std::int64_t>(z[0] * per_unit);
  a_sum_ = 2 * Int128{total} * a_depth;
  b_rise_ = static_cast<std::int64_t>(z[1] * per_unit) - a_depth;
  c_rise_ = static_cast<std::int64_t>(z[2] * per_unit) - a_depth;
}

void TriangleDepth::set_slope(std::int64_t b_step, std::int64_t c_step, double total) {
  const Int128 rise = Int128{b_step} * b_rise_ + Int128{c_step} * c_rise_;
  // Where it is needed, at most the largest depth; elsewhere it need only be finite.
  constexpr double kLargest = std::numeric_limits<double>::max();
  half_slope_ = std::clamp(to_double(rise) / (2 * total) * unit_, -kLargest, kLargest);
}

}  // namespace pipeline
