#include "libpipeline/scene/camera.h"

#include <array>
#include <cassert>
#include <string>
#include <type_traits>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

std::string to_text(const Vec3& v) {
  return shortest_text(v.x) + " " + shortest_text(v.y) + " " + shortest_text(v.z);
}

double number_above_zero(LineScanner& line, std::string_view name) {
  return number_where(line, name, "above 0", [](double value) { return value > 0; });
}

double number_other_than(double other, std::string_view other_name, LineScanner& line,
                         std::string_view name) {
  const std::string condition = "other than " + std::string(other_name);
  return number_where(line, name, condition, [&](double value) { return value != other; });
}

/// Takes `far`, the last number of every projection.
double far_beyond(double near, LineScanner& line) {
  return number_where(line, "far", "beyond near", [&](double value) { return value > near; });
}

/// Takes the optional aspect rule after a perspective's numbers, to the end of the line.
AspectRule read_aspect_rule(LineScanner& line) {
  if (line.at_end()) return AspectRule::angle;
  constexpr std::array<std::string_view, 2> kRules = {"ratio", "angle"};
  const bool is_ratio = line.peek() == "ratio";
  if (!is_ratio && line.peek() != "angle")
    line.fail("ratio, angle or the end of the line after far", spelling_hint(line.peek(), kRules));
  line.word();
  line.expect_end(is_ratio ? "'ratio'" : "'angle'");
  return is_ratio ? AspectRule::ratio : AspectRule::angle;
}

// S7, S8
Perspective read_perspective(LineScanner& line) {
  Perspective p;
  const auto is_inside_half_turn = [](double degrees) { return degrees > 0 && degrees < 180; };
  p.fov_y_degrees = number_where(line, "fovY", "above 0 and below 180 degrees", is_inside_half_turn);
  p.aspect = number_above_zero(line, "aspect");
  p.near = number_above_zero(line, "near");
  p.far = far_beyond(p.near, line);
  p.aspect_rule = read_aspect_rule(line);
  return p;
}

/// The six planes of a Frustum or an Orthographic.
// S7
template <typename Volume>
Volume read_volume(LineScanner& line) {
  Volume v;
  v.left = line.number("left");
  v.right = number_other_than(v.left, "left", line, "right");
  v.bottom = line.number("bottom");
  v.top = number_other_than(v.bottom, "bottom", line, "top");
  v.near = std::is_same_v<Volume, Frustum> ? number_above_zero(line, "near") : line.number("near");
  v.far = far_beyond(v.near, line);
  line.expect_end("far");
  return v;
}

/// A part of the camera besides the projection: its keyword, and its name in messages.
struct PositionPart {
  std::string_view keyword, name;
  std::optional<Located<Vec3>> CameraParameters::*part;
};
constexpr std::array<PositionPart, 3> kPositionParts = {
    {{"eye", "the eye", &CameraParameters::eye},
     {"look", "the point looked at", &CameraParameters::look},
     {"up", "the up direction", &CameraParameters::up}}};

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
  for (const auto& [word, name, part] : kPositionParts) {
    if (keyword != word) continue;
    if (camera.*part) throw given_twice(std::string(keyword), (camera.*part)->location, keyword_location);
    camera.*part = {line.vec3(name), location};
    return true;
  }
  if (keyword != "perspective" && keyword != "frustum" && keyword != "ortho") return false;
  if (camera.projection) throw given_twice("projection", camera.projection->location, keyword_location);
  camera.projection = {read_projection(keyword, line), location};
  return true;
}

bool is_parallel_to_view(const Vec3& eye, const Vec3& look, const Vec3& up) {
  const BallVec3 toward = to_balls(look) - to_balls(eye);
  const BallVec3 normal = cross(toward, to_balls(up));
  return dot(normal, normal).sign() == 0;
}

// S9
void check_camera(const CameraParameters& camera) {
  if (camera.up && camera.up->value == Vec3{})
    throw InputError(camera.up->location, "an up direction", "0 0 0");
  if (!camera.eye || !camera.look) return;
  if (camera.eye->value == camera.look->value)
    throw InputError(camera.look->location, "a point other than the eye to look at",
                     to_text(camera.look->value));
  if (camera.up && is_parallel_to_view(camera.eye->value, camera.look->value, camera.up->value))
    throw InputError(camera.up->location, "an up direction that is not parallel to the view direction",
                     to_text(camera.up->value));
}

CameraParameters merged(const CameraParameters& preferred, const CameraParameters& otherwise) {
  CameraParameters camera = preferred;
  for (const auto& [word, name, part] : kPositionParts)
    if (!(camera.*part)) camera.*part = otherwise.*part;
  if (!camera.projection) camera.projection = otherwise.projection;
  return camera;
}

}  // namespace pipeline
