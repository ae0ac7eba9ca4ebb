#include "libpipeline/numbers/ball_vec.h"

namespace pipeline {

BallVec3 operator-(const BallVec3& a, const BallVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
BallVec3 operator*(const BallVec3& a, const Ball& factor) {
  return {a.x * factor, a.y * factor, a.z * factor};
}
Ball dot(const BallVec3& a, const BallVec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

BallVec3 cross(const BallVec3& a, const BallVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

BallVec3 normalized(const BallVec3& a) {
  const Ball length = sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

BallVec3 to_balls(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace pipeline
