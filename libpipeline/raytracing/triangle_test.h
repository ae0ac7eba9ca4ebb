#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/raytracing/ndc_depth.h"
#include "libpipeline/raytracing/pixel_rays.h"

namespace pipeline {

/// The outcome of a hit test in doubles.
enum class HitResult {
  miss,
  hit,
  uncertain  // the ray is within the error bound of an edge
};

struct Hit {
  HitResult result = HitResult::miss;
  DepthInterval depth{};  // of a hit
};

/// The test of primary rays with triangles in view space that are in front of the eye plane (of any, if the
/// rays are parallel). A triangle is moved so that the ray is the z axis, and tested in two dimensions by
/// edge functions, which two triangles at an edge calculate alike (S. Woop, C. Benthin, I. Wald, "Watertight
/// ray/triangle intersection", 2013).
///
/// Each edge function has a bound on its error, which covers that of the ray and the distance between the
/// triangle and the one that `project` prints with all digits: its vertices are moved by 2^-53 of their x and
/// y in NDC, and by another 2^-53 where their text is a decimal. A hit or a miss is one of both triangles.
class TriangleTest {
 public:
  TriangleTest(const PixelRays& rays, const NdcDepth& depth)
      : depth_(depth), is_perspective_(rays.is_perspective()), reach_(rays.reach()) {}

  [[nodiscard]] Hit operator()(const Ray& ray, const Triangle& p_view) const {
    const std::array<Corner, 3> p = {corner(ray, p_view[0]), corner(ray, p_view[1]), corner(ray, p_view[2])};
    const EdgeFunction a = edge(p[1], p[2]), b = edge(p[2], p[0]), c = edge(p[0], p[1]);
    const bool may_be_front = a.value >= -a.error && b.value >= -b.error && c.value >= -c.error;
    const bool may_be_back = a.value <= a.error && b.value <= b.error && c.value <= c.error;
    const bool is_certain =
        std::fabs(a.value) > a.error && std::fabs(b.value) > b.error && std::fabs(c.value) > c.error;
    if (!is_certain) {
      // Comparisons with NaN fail: the products of huge numbers tell nothing.
      const bool is_number = a.value + b.value + c.value - a.error - b.error - c.error <= kLargest;
      return {may_be_front || may_be_back || !is_number ? HitResult::uncertain : HitResult::miss};
    }
    if (!may_be_front && !may_be_back) return {};
    return hit(p_view, a, b, c);
  }

 private:
  static constexpr double kLargest = std::numeric_limits<double>::max();
  // Where products underflow.
  static constexpr double kSmallest = 0x1p-1000;

  /// A vertex as the ray sees it.
  struct Corner {
    double x, y;
    double size;   // |x| + |y|
    double error;  // a bound on that of both, and more by a factor for the products
  };
  struct EdgeFunction {
    double value, error;
  };

  /// Moving costs a rounding of the product and one of the sum, each at most 2^-53 of `most`; the ray is off
  /// by 2^-49 reach, the vertex by 2^-52 of `most`.
  [[nodiscard]] Corner corner(const Ray& ray, const Vec3& p) const {
    const double distance = is_perspective_ ? -p.z : 1;
    const Vec3& way = is_perspective_ ? ray.direction : ray.origin;
    const double x = p.x - way.x * distance, y = p.y - way.y * distance;
    const double most = std::fabs(p.x) + std::fabs(p.y) + reach_ * std::fabs(distance);
    return {x, y, std::fabs(x) + std::fabs(y), 0x1p-47 * most};
  }
  /// Twice the area that the edge makes with the ray. The products are rounded by 2^-52 of size times size,
  /// which a sixteenth of the bound covers.
  static EdgeFunction edge(const Corner& from, const Corner& to) {
    return {from.x * to.y - from.y * to.x,
            from.error * to.size + to.error * from.size + from.error * to.error + kSmallest};
  }

  /// The distance is the mean of the vertices' by the areas opposite to them, which have the same sign.
  [[nodiscard]] Hit hit(const Triangle& p_view, const EdgeFunction& a, const EdgeFunction& b,
                        const EdgeFunction& c) const {
    const std::array<double, 3> w = {-p_view[0].z, -p_view[1].z, -p_view[2].z};
    const double nearest = std::min({w[0], w[1], w[2]}), farthest = std::max({w[0], w[1], w[2]});
    const double sum = a.value + b.value + c.value;
    const double mean = a.value * w[0] + b.value * w[1] + c.value * w[2];
    const double error_of_sum = a.error + b.error + c.error;
    const double size = std::fabs(sum);
    double error = error_of_sum / size;
    if (is_perspective_)
      error += (a.error * w[0] + b.error * w[1] + c.error * w[2]) / std::fabs(mean);
    else
      error *= 2;
    const DepthInterval depth = depth_.at(mean / sum, error + 0x1p-49, nearest, farthest);
    const bool is_known = size > kSmallest && size <= kLargest && depth.high - depth.low <= kLargest;
    return {is_known ? HitResult::hit : HitResult::uncertain, depth};
  }

  NdcDepth depth_;
  bool is_perspective_;
  double reach_;
};

}  // namespace pipeline
