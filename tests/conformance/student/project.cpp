// Stage 3: view space to NDC.

#include <utility>

#include "tests/conformance/student/stages.h"
#include "tests/conformance/student/switches.h"

namespace {

/// The tangent of half an angle in degrees.
double tan_of_half(double degrees) {
  const double angle = mistake("project/fov-in-radians") ? degrees : degrees * kPi / 180;
  if (mistake("project/tangent-halved")) return std::tan(angle) / 2;
  return std::tan(mistake("project/fov-not-halved") ? angle : angle / 2);
}

Matrix perspective(const Camera& camera) {
  const double fov_y = camera.numbers[0], aspect = camera.numbers[1];
  double near = camera.numbers[2], far = camera.numbers[3];
  if (mistake("project/near-and-far-swapped")) std::swap(near, far);

  double fov_x = fov_y * aspect;
  if (mistake("project/fovx-equals-fovy")) fov_x = fov_y;
  if (mistake("project/fovx-divided-by-aspect")) fov_x = fov_y / aspect;
  double t = near * tan_of_half(fov_y);
  double r = near * tan_of_half(fov_x);
  if (camera.rule == "ratio" || mistake("project/r-is-t-times-aspect")) r = t * aspect;
  if (mistake("project/r-and-t-swapped")) std::swap(r, t);
  if (mistake("project/near-left-out")) r /= near, t /= near;

  double a = -(far + near) / (far - near);
  double b = -(2 * far * near) / (far - near);
  if (mistake("project/missing-two")) b = b / 2;
  if (mistake("project/depth-from-0-to-1")) a = -far / (far - near), b = -far * near / (far - near);
  if (mistake("project/z-row-sign")) a = -a, b = -b;
  const double w = mistake("project/w-is-plus-z") ? 1 : -1;
  const double last = mistake("project/last-element-is-one") ? 1 : 0;
  const Matrix p = {{near / r, 0, 0, 0}, {0, near / t, 0, 0}, {0, 0, a, b}, {0, 0, w, last}};
  return mistake("project/matrix-transposed") ? transposed(p) : p;
}

/// From -1 at near to 1 at far, in even steps.
double linear_depth(double distance, const Camera& camera) {
  const double near = camera.numbers[camera.numbers.size() - 2], far = camera.numbers.back();
  return 2 * (distance - near) / (far - near) - 1;
}

Matrix ortho(const Camera& camera) {
  const double l = camera.numbers[0], r = camera.numbers[1], b = camera.numbers[2], t = camera.numbers[3];
  const double near = camera.numbers[4], far = camera.numbers[5];
  return {{2 / (r - l), 0, 0, -(r + l) / (r - l)},
          {0, 2 / (t - b), 0, -(t + b) / (t - b)},
          {0, 0, -2 / (far - near), -(far + near) / (far - near)},
          {0, 0, 0, 1}};
}

}  // namespace

std::vector<Triangle> project(const std::vector<Triangle>& triangles, const Camera& camera) {
  const Matrix p = camera.kind == "ortho" ? ortho(camera) : perspective(camera);
  std::vector<Triangle> result = triangles;
  for (Triangle& triangle : result)
    for (Vector& point : triangle.points) {
      const double distance = -point[2];
      point = homogeneous(p, point);
      if (mistake("project/depth-is-linear")) point[2] = point[3] * linear_depth(distance, camera);
      if (mistake("project/z-not-divided")) point[2] *= point[3];
      if (mistake("project/depth-in-view-space")) point[2] = -distance * point[3];
      if (mistake("project/depth-divided-twice")) point[2] /= point[3];
      if (mistake("project/no-divide")) point[3] = 1;
      if (mistake("project/divided-twice")) point[3] *= point[3];
      point = {point[0] / point[3], point[1] / point[3], point[2] / point[3]};
    }
  return result;
}
