#pragma once

#include <cstdint>
#include <limits>

#include "libpipeline/config.h"

namespace pipeline {

// How a depth is kept. A format rounds depths to what it can store and compares what is stored, so two depths that
// round to the same are equal and the earlier triangle stays. `store` is monotone; `depth` gives back the depth a stored
// value stands for. Two depths, neither larger than `size`, of which one exceeds the other by `separation(size)` or more
// are never stored as the same value.

/// A double: what was calculated.
struct DepthF64 {
  using Stored = double;
  explicit DepthF64(const ScreenConfig&) {}
  [[nodiscard]] static Stored store(double z) { return z; }
  [[nodiscard]] static double depth(Stored stored) { return stored; }
  [[nodiscard]] static double separation(double) { return std::numeric_limits<double>::denorm_min(); }
};

/// A float, 24 bits that are finer near 0.
struct DepthF32 {
  using Stored = float;
  explicit DepthF32(const ScreenConfig&) {}
  [[nodiscard]] static Stored store(double z) { return static_cast<float>(z); }
  [[nodiscard]] static double depth(Stored stored) { return stored; }
  // More than the distance of neighbouring floats.
  [[nodiscard]] static double separation(double size) {
    const bool is_in_range = size <= std::numeric_limits<float>::max();
    return is_in_range ? size * 0x1.01p-23 + 0x1p-148 : std::numeric_limits<double>::infinity();
  }
};

/// A whole number of equal steps between the front and the rear limit, as graphics hardware keeps it: the limits are
/// stored exactly, what lies between is rounded to the nearest step, half a step up.
template <typename Whole, Whole kSteps>
class DepthSteps {
 public:
  using Stored = Whole;
  explicit DepthSteps(const ScreenConfig& screen)
      : front_(screen.front),
        steps_per_depth_(static_cast<double>(kSteps) / (screen.rear - screen.front)),
        depth_per_step_((screen.rear - screen.front) / static_cast<double>(kSteps)) {}
  /// `z` outside the limits is stored as the nearer limit.
  [[nodiscard]] Stored store(double z) const {
    const double steps = (z - front_) * steps_per_depth_ + 0.5;
    const double highest = static_cast<double>(kSteps);
    return static_cast<Stored>(steps > highest ? highest : (steps > 0 ? steps : 0));
  }
  [[nodiscard]] double depth(Stored stored) const { return front_ + static_cast<double>(stored) * depth_per_step_; }
  // More than a step by what `store` may be off before it rounds, less than 2^-26 steps.
  [[nodiscard]] double separation(double) const { return depth_per_step_ * (1 + 0x1p-20); }

 private:
  double front_;
  double steps_per_depth_;
  double depth_per_step_;
};

using DepthU24 = DepthSteps<std::uint32_t, (1u << 24) - 1>;
using DepthU16 = DepthSteps<std::uint16_t, 65535>;

}  // namespace pipeline
