#include "libpipeline/scene/camera.h"

#include <cassert>
#include <string>
#include <type_traits>

#include "libpipeline/numbers/ball_vec.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

std::string to_text(const Vec3& v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

/// Takes the next number; an error at its place unless `holds` is true of it.
template <typename Condition>
double checked_number(LineScanner& line, const std::string& name, const std::string& condition,
                      Condition holds) {
  const LineScanner at_number = line;
  const double value = line.number(name);
  if (!holds(value)) at_number.fail(name + " " + condition);
  return value;
}

double number_above_zero(LineScanner& line, const std::string& name) {
  return checked_number(line, name, "above 0", [](double value) { return value > 0; });
}

double number_other_than(double other, LineScanner& line, const std::string& name,
                         const std::string& other_name) {
  return checked_number(line, name, "other than " + other_name, [&](double value) { return value != other; });
}

/// The last number of every projection.
double far_beyond(double near, LineScanner& line) {
  const double far = checked_number(line, "far", "beyond near", [&](double value) { return value > near; });
  line.expect_end("far");
  return far;
}

Perspective read_perspective(LineScanner& line) {
  Perspective p;
  p.fov_y_degrees = checked_number(line, "fovY", "above 0 and below 180 degrees",
                                   [](double value) { return value > 0 && value < 180; });
  p.aspect = number_above_zero(line, "aspect");
  p.near = number_above_zero(line, "near");
  p.far = far_beyond(p.near, line);
  return p;
}

/// The six planes of a frustum or of an orthographic volume, which hold the same fields.
template <typename Volume>
Volume read_volume(LineScanner& line) {
  Volume v;
  v.left = line.number("left");
  v.right = number_other_than(v.left, line, "right", "left");
  v.bottom = line.number("bottom");
  v.top = number_other_than(v.bottom, line, "top", "bottom");
  v.near = std::is_same_v<Volume, Frustum> ? number_above_zero(line, "near") : line.number("near");
  v.far = far_beyond(v.near, line);
  return v;
}

template <typename T>
void expect_first(const std::optional<Located<T>>& part, const SourceLocation& location,
                  const std::string& name) {
  if (part)
    throw InputError(location,
                     expected_but_found("one " + name, "a second one after " + to_string(part->location)));
}

/// The part of the camera with that keyword and what messages call it; nothing for other keywords.
struct PositionPart {
  std::optional<Located<Vec3>> CameraParameters::*part = nullptr;
  std::string_view name;
};

PositionPart position_part(std::string_view keyword) {
  if (keyword == "eye") return {&CameraParameters::eye, "the eye"};
  if (keyword == "look") return {&CameraParameters::look, "the point looked at"};
  if (keyword == "up") return {&CameraParameters::up, "the up direction"};
  return {};
}

}  // namespace

Projection read_projection(std::string_view keyword, LineScanner& line) {
  if (keyword == "perspective") return read_perspective(line);
  if (keyword == "frustum") return read_volume<Frustum>(line);
  assert(keyword == "ortho");
  return read_volume<Orthographic>(line);
}

bool read_camera_part(std::string_view keyword, const SourceLocation& keyword_location, LineScanner& line,
                      CameraParameters& camera) {
  const SourceLocation location = line.location();
  if (const auto [part, name] = position_part(keyword); part != nullptr) {
    expect_first(camera.*part, keyword_location, std::string(keyword));
    camera.*part = {line.vec3(name), location};
    return true;
  }
  if (keyword != "perspective" && keyword != "frustum" && keyword != "ortho") return false;
  expect_first(camera.projection, keyword_location, "projection");
  camera.projection = {read_projection(keyword, line), location};
  return true;
}

bool is_parallel_to_view(const Vec3& eye, const Vec3& look, const Vec3& up) {
  const BallVec3 toward = to_balls(look) - to_balls(eye);
  const BallVec3 normal = cross(toward, to_balls(up));
  return dot(normal, normal).sign() == 0;
}

void check_camera(const CameraParameters& camera) {
  if (camera.up && camera.up->value == Vec3{})
    throw InputError(camera.up->location, expected_but_found("an up direction", "0 0 0"));
  if (!camera.eye || !camera.look) return;
  if (camera.eye->value == camera.look->value)
    throw InputError(camera.look->location, expected_but_found("a point other than the eye to look at",
                                                               to_text(camera.look->value)));
  if (camera.up && is_parallel_to_view(camera.eye->value, camera.look->value, camera.up->value))
    throw InputError(camera.up->location,
                     expected_but_found("an up direction that is not parallel to the view direction",
                                        to_text(camera.up->value)));
}

CameraParameters without_position(const CameraParameters& camera) {
  CameraParameters rest;
  rest.projection = camera.projection;
  return rest;
}

CameraParameters merged(const CameraParameters& preferred, const CameraParameters& otherwise) {
  CameraParameters camera = preferred;
  if (!camera.eye) camera.eye = otherwise.eye;
  if (!camera.look) camera.look = otherwise.look;
  if (!camera.up) camera.up = otherwise.up;
  if (!camera.projection) camera.projection = otherwise.projection;
  return camera;
}

}  // namespace pipeline
