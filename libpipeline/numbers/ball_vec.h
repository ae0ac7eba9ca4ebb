#pragma once

#include "libpipeline/numbers/ball.h"
#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A vector of balls: each component carries its error bound.
struct BallVec3 {
  Ball x, y, z;

  friend bool operator==(const BallVec3&, const BallVec3&) = default;
};

BallVec3 operator-(const BallVec3& a, const BallVec3& b);
BallVec3 operator*(const BallVec3& a, const Ball& factor);
Ball dot(const BallVec3& a, const BallVec3& b);
BallVec3 cross(const BallVec3& a, const BallVec3& b);
/// The unit vector in a's direction; `a` must not contain 0 and may have any finite length.
BallVec3 normalized(const BallVec3& a);
BallVec3 to_balls(const Vec3& v);

}  // namespace pipeline
