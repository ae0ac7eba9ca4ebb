#pragma once

#include <algorithm>
#include <limits>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// The smallest box with sides parallel to the axes around some points; infinite and inside out if there are
/// none.
struct BoundingBox {
  BoundingBox() = default;
  explicit BoundingBox(const Triangle& p)
      : low(smallest(smallest(p[0], p[1]), p[2])), high(largest(largest(p[0], p[1]), p[2])) {}

  void add(const BoundingBox& box) {
    low = smallest(low, box.low);
    high = largest(high, box.high);
  }
  void add(const Triangle& triangle) { add(BoundingBox(triangle)); }

  Vec3 low = {kInfinity, kInfinity, kInfinity};
  Vec3 high = {-kInfinity, -kInfinity, -kInfinity};

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();

  static Vec3 smallest(const Vec3& a, const Vec3& b) {
    return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
  }
  static Vec3 largest(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
  }
};

}  // namespace pipeline
