#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The smallest and the largest x, y and z of the vertices that a stage writes, with all the digits that
/// decide how they are printed; of a sphere's surface, to a few roundings.
class CoordinateExtent {
 public:
  /// A double and its low part.
  using Coordinate = std::pair<double, double>;
  struct Range {
    Coordinate low;
    Coordinate high;
  };

  void add(const TriangleBatch& batch) {
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const Triangle low_part = batch.low_parts.empty() ? Triangle{} : batch.low_parts[i];
      for (std::size_t v = 0; v < 3; ++v) add(batch.triangles[i][v], low_part[v]);
    }
    for (const Sphere& sphere : batch.spheres) {
      for (std::size_t v = 0; v < sphere.points.size(); ++v) add(sphere.points[v], sphere.low_parts[v]);
      add(sphere.points);
    }
  }
  /// The ranges of x, y and z; none where there is no vertex.
  [[nodiscard]] const std::array<std::optional<Range>, 3>& ranges() const { return ranges_; }

 private:
  void add(const Vec3& p, const Vec3& low_part) {
    add(0, {p.x, low_part.x});
    add(1, {p.y, low_part.y});
    add(2, {p.z, low_part.z});
  }
  /// The points c + u a + v b + w d with u^2 + v^2 + w^2 = 1 are up to sqrt(a^2 + b^2 + d^2) from c in each
  /// coordinate.
  void add(const SpherePoints& points) {
    const auto& [c, a, b, d] = points;
    Vec3 reach;
    for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      const Vec3 v = {a.*axis - c.*axis, b.*axis - c.*axis, d.*axis - c.*axis};
      reach.*axis = std::sqrt(dot(v, v));
    }
    add(difference(c, reach), {});
    add(sum(c, reach), {});
  }
  void add(std::size_t axis, const Coordinate& c) {
    std::optional<Range>& range = ranges_[axis];
    if (!range) range = {c, c};
    if (c < range->low) range->low = c;
    if (range->high < c) range->high = c;
  }

  std::array<std::optional<Range>, 3> ranges_;
};

}  // namespace pipeline
