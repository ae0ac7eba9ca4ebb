#pragma once

#include <algorithm>
#include <limits>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// The smallest box with sides parallel to the axes around some points; infinite and inside out if there are
/// none.
struct BoundingBox {
  BoundingBox() = default;
  explicit BoundingBox(const Triangle& triangle) { add(triangle); }

  void add(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void add(const Triangle& triangle) {
    for (const Vec3& vertex : triangle) add(vertex);
  }
  void add(const BoundingBox& box) {
    add(box.low);
    add(box.high);
  }

  Vec3 low = {kInfinity, kInfinity, kInfinity};
  Vec3 high = {-kInfinity, -kInfinity, -kInfinity};

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

}  // namespace pipeline
