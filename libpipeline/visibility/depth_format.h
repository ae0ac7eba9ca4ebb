#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>

#include "libpipeline/coverage/type_list.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

// The formats in which the z-buffer stores depths. A format rounds depths to stored values and compares
// these, so two depths that round to the same value are equal, and the earlier triangle stays. `store` is
// monotone; `depth` gives the depth of a stored value. Two depths between the limits that differ by
// `separation(size)` or more, neither larger than `size`, are never stored as the same value. kName is the
// word that chooses the format, kMeaning its line in --help. `needed_limits` is empty if the format has room
// for the depths between a screen's limits, else it says which limits the format needs.

/// The depth rule: a fragment is drawn if it is not before the front limit, and wins a pixel if its stored
/// depth is less than the pixel's.
// Z8
constexpr bool is_drawn(double z, double front) {
  return z >= front;
}
template <typename Stored>
constexpr bool is_nearer(Stored stored, Stored of_pixel) {
  return stored < of_pixel;
}

/// A double, the depth as calculated.
struct DepthF64 {
  static constexpr std::string_view kName = "f64", kMeaning = "as a double";
  using Stored = double;
  explicit DepthF64(const Viewport&) {}
  [[nodiscard]] static std::string_view needed_limits(const Viewport&) { return {}; }
  [[nodiscard]] static Stored store(double z) { return z; }
  [[nodiscard]] static double depth(Stored stored) { return stored; }
  [[nodiscard]] static double separation(double) { return std::numeric_limits<double>::denorm_min(); }
};

/// A float with 24 significant bits, so steps are finer near 0.
struct DepthF32 {
  static constexpr std::string_view kName = "f32", kMeaning = "as a float";
  using Stored = float;
  explicit DepthF32([[maybe_unused]] const Viewport& screen) { assert(needed_limits(screen).empty()); }
  [[nodiscard]] static std::string_view needed_limits(const Viewport& screen) {
    const Stored front = store(screen.front), rear = store(screen.rear);
    if (!std::isfinite(front) || !std::isfinite(rear)) return "from -3.4028235e+38 to 3.4028235e+38";
    return front < rear ? "" : "that are two different floats";
  }
  [[nodiscard]] static Stored store(double z) { return static_cast<float>(z); }
  [[nodiscard]] static double depth(Stored stored) { return stored; }
  // More than the distance between neighboring floats.
  [[nodiscard]] static double separation(double size) {
    const bool is_in_range = size <= std::numeric_limits<float>::max();
    return is_in_range ? size * 0x1.01p-23 + 0x1p-148 : std::numeric_limits<double>::infinity();
  }
};

/// A whole number of 2^24 - 1 equal steps between the front and the rear limit, as in graphics hardware: the
/// limits are stored exactly; depths between them are rounded to the nearest step, halves up. Finer than a
/// float if the limits are close together, like 0.999 and 1. Signed, because processors convert doubles only
/// to signed numbers.
struct DepthU24 {
  static constexpr std::string_view kName = "u24", kMeaning = "in 2^24 - 1 equal steps between the limits";
  using Stored = std::int32_t;
  static constexpr double kSteps = (1 << 24) - 1;
  explicit DepthU24(const Viewport& screen)
      : front(screen.front),
        steps_per_depth(kSteps / (screen.rear - screen.front)),
        depth_per_step((screen.rear - screen.front) / kSteps) {
    assert(needed_limits(screen).empty());
  }
  [[nodiscard]] static std::string_view needed_limits(const Viewport& screen) {
    // With closer limits, a step or the number of steps per unit would leave a double's range.
    const double distance = screen.rear - screen.front;
    return 1e-300 <= distance && std::isfinite(distance) ? "" : "1e-300 to 1.7976931e+308 apart";
  }
  /// The stored value of `z`; outside the limits, the nearer limit's.
  [[nodiscard]] Stored store(double z) const {
    const double steps = (z - front) * steps_per_depth + 0.5;
    const double steps_from_front = steps > 0 ? steps : 0;
    return static_cast<Stored>(kSteps < steps_from_front ? kSteps : steps_from_front);
  }
  [[nodiscard]] double depth(Stored stored) const { return front + stored * depth_per_step; }
  // One step plus more than the error of `store` before rounding, which is less than 2^-26 steps.
  [[nodiscard]] double separation(double) const { return depth_per_step * (1 + 0x1p-20); }

  double front;
  double steps_per_depth;
  double depth_per_step;
};

/// Every depth format, in the order of --help; the first is the default. The macro has the same list, for
/// functions compiled once per format.
#define PIPELINE_FOR_EACH_DEPTH_FORMAT(DO) DO(DepthF64) DO(DepthF32) DO(DepthU24)
using DepthFormats = TypeList<DepthF64, DepthF32, DepthU24>;

}  // namespace pipeline
