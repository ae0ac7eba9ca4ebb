#include "libpipeline/vertex/transform.h"

#include <cmath>
#include <string>
#include <type_traits>

#include "libpipeline/numbers/angle.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// Turns x by t about the unit axis a: cos(t) x + (1 - cos(t)) (a . x) a + sin(t) cross(a, x).
BallVec3 rodrigues(const BallVec3& x, const BallVec3& axis, const SineCosine& angle) {
  const BallVec3 kept = x * angle.cosine;
  const BallVec3 along = axis * (angle.versine * dot(axis, x));
  const BallVec3 turned = cross(axis, x) * angle.sine;
  return {kept.x + along.x + turned.x, kept.y + along.y + turned.y, kept.z + along.z + turned.z};
}

/// 1 / tan(angle / 2); the angle, an exact product, must lie in (0, 180) degrees.
Ball cotangent_of_half(const Ball& angle_degrees) {
  // This close to 0, 1 / tan(x / 2) is 2 / x to far more digits than a ball has.
  if (angle_degrees.nearest_double() < kTinyDegrees) return Ball(2) / to_radians(angle_degrees);
  const DoubleDouble angle = angle_degrees.value();
  const SineCosine half = sine_cosine_of_degrees({angle.hi / 2, angle.lo / 2});
  return half.cosine / half.sine;
}

bool is_inside_half_turn(const Ball& degrees) {
  return degrees.sign() > 0 && (degrees - Ball(180)).sign() < 0;
}

/// The sides of a symmetric perspective.
std::optional<VolumeSides> sides_by_scale(const Ball& scale, double high = 1) {
  if (!scale.is_exact() || scale.value().lo != 0) return std::nullopt;
  return VolumeSides{scale.nearest_double(), -high, high};
}

// P2
ProjectionTransform perspective(const Perspective& p, const SourceLocation& location) {
  ProjectionTransform transform;
  transform.y_scale = cotangent_of_half(p.fov_y_degrees);
  transform.sides[1] = sides_by_scale(transform.y_scale);
  if (p.aspect_rule == AspectRule::ratio) {
    transform.x_scale = transform.y_scale / Ball(p.aspect);
    transform.sides[0] = sides_by_scale(transform.y_scale, p.aspect);
  } else {
    const Ball fov_x_degrees = Ball(p.fov_y_degrees) * Ball(p.aspect);
    if (!is_inside_half_turn(fov_x_degrees))
      throw InputError(location,
                       "fovX = fovY * aspect above 0 and below 180 degrees (or --aspect "
                       "ratio; in a scene, the word ratio at the end)",
                       shortest_text(p.fov_y_degrees) + " * " + shortest_text(p.aspect));
    transform.x_scale = cotangent_of_half(fov_x_degrees);
    transform.sides[0] = sides_by_scale(transform.x_scale);
  }
  transform.near = p.near;
  transform.far = p.far;
  return transform;
}

/// The projection of a Frustum, or of an Orthographic, whose window is the same at every distance.
// P3
template <typename Volume>
ProjectionTransform volume(const Volume& v) {
  constexpr bool kIsPerspective = std::is_same_v<Volume, Frustum>;
  const double at = kIsPerspective ? v.near : 1;
  const auto offset = [](const Ball& sum) { return kIsPerspective ? sum : -sum; };
  const Ball width = Ball(v.right) - Ball(v.left);
  const Ball height = Ball(v.top) - Ball(v.bottom);
  ProjectionTransform transform;
  transform.is_perspective = kIsPerspective;
  transform.x_scale = Ball(2) * Ball(at) / width;
  transform.x_offset = offset(Ball(v.right) + Ball(v.left)) / width;
  transform.y_scale = Ball(2) * Ball(at) / height;
  transform.y_offset = offset(Ball(v.top) + Ball(v.bottom)) / height;
  transform.near = v.near;
  transform.far = v.far;
  transform.sides = {VolumeSides{at, v.left, v.right}, VolumeSides{at, v.bottom, v.top}};
  return transform;
}

}  // namespace

// M4
AffineMatrix rotation(double angle_degrees, const Vec3& axis) {
  const BallVec3 unit_axis = normalized(to_balls(axis));
  const SineCosine angle = sine_cosine_of_degrees({angle_degrees, 0});
  AffineMatrix::Rows rows;
  for (std::size_t j = 0; j < 3; ++j) {
    const BallVec3 unit = {j == 0 ? 1.0 : 0.0, j == 1 ? 1.0 : 0.0, j == 2 ? 1.0 : 0.0};
    const BallVec3 column = rodrigues(unit, unit_axis, angle);
    rows[0][j] = column.x;
    rows[1][j] = column.y;
    rows[2][j] = column.z;
  }
  return {rows, 1};
}

// V2
ViewTransform view_from_world(const Vec3& eye, const Vec3& look, const Vec3& up) {
  const BallVec3 toward = to_balls(look) - to_balls(eye);
  const BallVec3 forward = normalized(toward);
  // The cross product of the vectors as given, not normalized: they may be almost parallel.
  const BallVec3 right = normalized(cross(toward, to_balls(up)));
  const BallVec3 camera_up = cross(right, forward);
  return {eye, right, camera_up, {-forward.x, -forward.y, -forward.z}};
}

ProjectionTransform clip_from_view(const Located<Projection>& projection) {
  if (const auto* p = std::get_if<Perspective>(&projection.value))
    return perspective(*p, projection.location);
  if (const auto* f = std::get_if<Frustum>(&projection.value)) return volume(*f);
  return volume(std::get<Orthographic>(projection.value));
}

Projection volume_of(const Located<Projection>& projection, const ProjectionTransform& transform) {
  if (!std::holds_alternative<Perspective>(projection.value)) return projection.value;
  // All three have far more digits than a double, so the midpoint's nearest double is the quotient's.
  const double right = (Ball(transform.near) / transform.x_scale).nearest_double();
  const double top = (Ball(transform.near) / transform.y_scale).nearest_double();
  if (!std::isfinite(right) || !std::isfinite(top))
    throw InputError(projection.location, "a perspective whose window is within a double's range",
                     std::string("an overflow of its ") + (std::isfinite(right) ? "height" : "width"));
  return Frustum{-right, right, -top, top, transform.near, transform.far};
}

ViewFromClip::ViewFromClip(const ProjectionTransform& projection)
    : is_perspective_(projection.is_perspective),
      x_scale_(projection.x_scale.nearest_double()),
      x_offset_(projection.x_offset.nearest_double()),
      y_scale_(projection.y_scale.nearest_double()),
      y_offset_(projection.y_offset.nearest_double()),
      near_(projection.near),
      far_(projection.far) {}

/// z_ndc = ((d - n) f - (f - d) n) / (d (f - n)), solved for d.
// L2
double ViewFromClip::w_of(const Vec3& p_ndc) const {
  if (!is_perspective_) return 1;
  return 2 * far_ * near_ / (far_ * (1 - p_ndc.z) + near_ * (1 + p_ndc.z));
}

Vec3 ViewFromClip::operator()(const Vec3& p_clip, double w) const {
  if (is_perspective_)
    return {(p_clip.x + x_offset_ * w) / x_scale_, (p_clip.y + y_offset_ * w) / y_scale_, -w};
  const double distance = (far_ * (1 + p_clip.z) + near_ * (1 - p_clip.z)) / 2;
  return {(p_clip.x - x_offset_) / x_scale_, (p_clip.y - y_offset_) / y_scale_, -distance};
}

}  // namespace pipeline
