// Stage 2: world space to view space.

#include <utility>

#include "tests/conformance/student/stages.h"
#include "tests/conformance/student/switches.h"

namespace {

Matrix view_matrix(Camera camera) {
  if (mistake("view/eye-and-look-exchanged")) std::swap(camera.eye, camera.look);
  if (mistake("view/up-is-a-point")) camera.up = minus(camera.up, camera.eye);
  if (mistake("view/up-is-0-1-0")) camera.up = {0, 1, 0};
  Vector l = minus(camera.look, camera.eye);
  if (mistake("view/l-is-eye-minus-look")) l = minus(camera.eye, camera.look);
  const auto cross = [](const Vector& a, const Vector& b) {
    Vector c = ::cross(a, b);
    if (mistake("view/cross-product-sign")) c[1] = -c[1];
    return c;
  };
  if (mistake("view/look-is-a-direction")) l = camera.look;
  if (!mistake("view/l-not-unit")) l = normalized(l);
  const bool is_left_handed = mistake("view/left-handed");
  Vector r = mistake("view/r-is-up-cross-l") || is_left_handed ? cross(camera.up, l) : cross(l, camera.up);
  if (!mistake("view/r-not-unit")) r = normalized(r);
  Vector u = mistake("view/u-is-l-cross-r") || is_left_handed ? cross(l, r) : cross(r, l);
  if (mistake("view/up-as-given")) u = camera.up;
  const double sign = mistake("view/l-not-negated") || is_left_handed ? 1 : -1;

  Matrix turn = {
      {r[0], r[1], r[2], 0}, {u[0], u[1], u[2], 0}, {sign * l[0], sign * l[1], sign * l[2], 0}, {0, 0, 0, 1}};
  if (mistake("view/rotation-transposed")) turn = transposed(turn);
  if (mistake("view/no-rotation")) turn = identity();

  Vector move = {-camera.eye[0], -camera.eye[1], -camera.eye[2]};
  if (mistake("view/eye-added")) move = camera.eye;
  if (mistake("view/no-translation")) move = {0, 0, 0};
  if (mistake("view/translation-after-rotation")) return product(translation(move), turn);
  return product(turn, translation(move));
}

}  // namespace

std::vector<Triangle> view(const std::vector<Triangle>& world, const Camera& camera) {
  Matrix v = view_matrix(camera);
  if (mistake("view/matrix-transposed")) v = transposed(v);
  std::vector<Triangle> result = world;
  for (Triangle& triangle : result)
    for (Vector& point : triangle.points) {
      point = homogeneous(v, point);
      point.pop_back();  // w is 1
    }
  return result;
}
