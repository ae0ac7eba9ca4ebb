#include "tools/mesh2scene/framing.h"

#include <algorithm>
#include <limits>

#include "libpipeline/numbers/angle.h"
#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Direction {
  double cosine, sine;
};

/// Without libm, whose last bits differ between systems.
Direction direction_of(double degrees) {
  const SineCosine angle = sine_cosine_of_degrees({degrees, 0});
  return {angle.cosine.nearest_double(), angle.sine.nearest_double()};
}

double tangent(double degrees) {
  const Direction direction = direction_of(degrees);
  return direction.sine / direction.cosine;
}

/// Depths behind and before the model that belong to the view, as fractions of its distance: room for objects
/// that are added to the scene.
constexpr double kDepthMargin = 0.5;
/// A depth buffer tells little apart if far is more than this many times near.
constexpr double kMostDepth = 10000;

}  // namespace

Vec3 unit_vector_of(UpAxis axis) {
  return {axis == UpAxis::x ? 1.0 : 0.0, axis == UpAxis::y ? 1.0 : 0.0, axis == UpAxis::z ? 1.0 : 0.0};
}

ViewAxes view_axes(UpAxis up_axis, double azimuth_degrees, double elevation_degrees) {
  const Vec3 up = unit_vector_of(up_axis);
  const Vec3 front = up_axis == UpAxis::z ? Vec3{0, -1, 0} : Vec3{0, 0, 1};
  const Vec3 side = cross(up, front);
  const auto [cos_a, sin_a] = direction_of(azimuth_degrees);
  const auto [cos_e, sin_e] = direction_of(elevation_degrees);
  const Vec3 toward = sum(scaled(front, cos_a), scaled(side, sin_a));
  const Vec3 back = sum(scaled(toward, cos_e), scaled(up, sin_e));
  const Vec3 right = difference(scaled(side, cos_a), scaled(front, sin_a));
  return {right, cross(back, right), back};
}

Framing::Framing(const ViewAxes& axes, double fov_y_degrees, double aspect, double share)
    : axes_(axes),
      slope_x_(share * aspect * tangent(fov_y_degrees / 2)),
      slope_y_(share * tangent(fov_y_degrees / 2)),
      right_(-kInfinity),
      left_(-kInfinity),
      top_(-kInfinity),
      bottom_(-kInfinity),
      nearest_(-kInfinity),
      farthest_(kInfinity) {}

void Framing::add(const Vec3& p) {
  const double a = dot(p, axes_.right), b = dot(p, axes_.up), c = dot(p, axes_.back);
  right_ = std::max(right_, a + slope_x_ * c);
  left_ = std::max(left_, -a + slope_x_ * c);
  top_ = std::max(top_, b + slope_y_ * c);
  bottom_ = std::max(bottom_, -b + slope_y_ * c);
  nearest_ = std::max(nearest_, c);
  farthest_ = std::min(farthest_, c);
}

// An eye at (x, y, z) sees a point (a, b, c) within the share if |a - x| <= slope_x (z - c) and |b - y| <=
// slope_y (z - c): a + slope_x c <= x + slope_x z and -a + slope_x c <= -x + slope_x z. Added up, they give
// the least z.
FramingCamera Framing::camera(const std::optional<Vec3>& at, double zoom) const {
  const double x = (right_ - left_) / 2, y = (top_ - bottom_) / 2;
  const double z = std::max((right_ + left_) / (2 * slope_x_), (top_ + bottom_) / (2 * slope_y_));
  const double middle = nearest_ + (farthest_ - nearest_) / 2;
  const auto on_axis = [&](double depth) {
    return sum(sum(scaled(axes_.right, x), scaled(axes_.up, y)), scaled(axes_.back, depth));
  };
  FramingCamera camera;
  camera.eye = on_axis(z);
  camera.look = on_axis(middle);
  camera.up = axes_.up;
  camera.distance = z - middle;
  double eye_depth = z;
  if (at || zoom != 1) {
    if (at) camera.look = *at;
    camera.distance /= zoom;
    camera.eye = sum(camera.look, scaled(axes_.back, camera.distance));
    eye_depth = dot(camera.eye, axes_.back);
  }
  camera.far = (eye_depth - farthest_) + kDepthMargin * camera.distance;
  camera.near = std::max((eye_depth - nearest_) * kDepthMargin, camera.far / kMostDepth);
  return camera;
}

}  // namespace pipeline
