#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The smallest and the largest x, y and z of the vertices that a stage writes, with all the digits that
/// decide how they are printed.
class CoordinateExtent {
 public:
  /// A double, and the part that it does not hold.
  using Coordinate = std::pair<double, double>;
  struct Range {
    Coordinate low;
    Coordinate high;
  };

  void add(const TriangleBatch& batch) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Triangle low_part = batch.low_parts.empty() ? Triangle{} : batch.low_parts[i];
      for (std::size_t v = 0; v < 3; ++v) {
        const Vec3& p = batch.triangles[i][v];
        add(0, {p.x, low_part[v].x});
        add(1, {p.y, low_part[v].y});
        add(2, {p.z, low_part[v].z});
      }
    }
  }
  /// Of x, y and z; none where there is no vertex.
  [[nodiscard]] const std::array<std::optional<Range>, 3>& ranges() const { return ranges_; }

 private:
  void add(std::size_t axis, const Coordinate& c) {
    std::optional<Range>& range = ranges_[axis];
    if (!range) range = {c, c};
    if (c < range->low) range->low = c;
    if (range->high < c) range->high = c;
  }

  std::array<std::optional<Range>, 3> ranges_;
};

}  // namespace pipeline
