#pragma once

#include <array>

#include "libpipeline/vec.h"

namespace pipeline {

// Vectors in doubles, for what is interpolated and lit. Positions are calculated with error bounds (ball.h).

inline double dot(const Vec3& a, const Vec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

inline Vec3 sum(const Vec3& a, const Vec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

inline Vec3 difference(const Vec3& a, const Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

inline Vec3 scaled(const Vec3& v, double factor) {
  return {factor * v.x, factor * v.y, factor * v.z};
}

inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The mean of the corners of a triangle, or of what belongs to them; the weights add up to 1.
inline Vec3 mean(const std::array<Vec3, 3>& corners, const std::array<double, 3>& weights) {
  const auto& [a, b, c] = corners;
  const auto& [i, j, k] = weights;
  return {i * a.x + j * b.x + k * c.x, i * a.y + j * b.y + k * c.y, i * a.z + j * b.z + k * c.z};
}

}  // namespace pipeline
