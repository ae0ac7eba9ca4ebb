#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "libpipeline/numbers/vec.h"

namespace pipeline {

// Vectors in doubles, for interpolation and lighting. Positions are computed with error bounds (ball.h).

inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vec3 sum(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline Vec3 difference(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

/// The product of each coordinate.
inline Vec3 product(const Vec3& a, const Vec3& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}

inline Vec3 scaled(const Vec3& v, double factor) {
  return {factor * v.x, factor * v.y, factor * v.z};
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The largest magnitude of a coordinate.
inline double largest_in(const Vec3& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

/// The unit vector in v's direction, 0 for 0. v may have any finite length.
inline Vec3 unit_vector(const Vec3& v) {
  const double largest = largest_in(v);
  if (largest == 0) return {};
  // Scaled first, so that no square overflows and the largest does not underflow.
  const Vec3 near_1 = {v.x / largest, v.y / largest, v.z / largest};
  const double length = std::sqrt(dot(near_1, near_1));
  return {near_1.x / length, near_1.y / length, near_1.z / length};
}

/// The normal of a triangle's plane, of any length, on the side from which the triangle is counterclockwise.
inline Vec3 face_normal(const Triangle& p) {
  return cross(difference(p[1], p[0]), difference(p[2], p[0]));
}

/// The weighted mean of a triangle's vertices or of their attributes; the weights add up to 1.
inline double mean(const std::array<double, 3>& corners, const std::array<double, 3>& weights) {
  return weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
}
inline Vec3 mean(const std::array<Vec3, 3>& corners, const std::array<double, 3>& weights) {
  const auto& [a, b, c] = corners;
  return {mean(std::array{a.x, b.x, c.x}, weights), mean(std::array{a.y, b.y, c.y}, weights),
          mean(std::array{a.z, b.z, c.z}, weights)};
}

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
