#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/header_line.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// gluPerspective's parameters. `near` and `far` are distances from the eye, 0 < near < far.
struct Perspective {
  double fov_y_degrees = 0;
  double aspect = 1;
  double near = 0;
  double far = 0;
};

/// glFrustum's parameters: the window on the near plane, 0 < near < far.
struct Frustum {
  double left = 0, right = 0, bottom = 0, top = 0, near = 0, far = 0;
};

/// glOrtho's parameters; near and far may have any sign, near < far.
struct Orthographic {
  double left = 0, right = 0, bottom = 0, top = 0, near = 0, far = 0;
};

using Projection = std::variant<Perspective, Frustum, Orthographic>;

/// What a scene or a stage text's header says of the camera, as far as it says it.
/// `look` is the point looked at, in world space like `eye`.
struct CameraParameters {
  std::optional<Located<Vec3>> eye;
  std::optional<Located<Vec3>> look;
  std::optional<Located<Vec3>> up;
  std::optional<Located<Projection>> projection;
};

/// Reads what follows the keyword `perspective`, `frustum` or `ortho`, and checks it: fovY lies in (0, 180)
/// degrees, aspect > 0, near < far, near > 0 for a perspective, left != right, bottom != top.
Projection read_projection(std::string_view keyword, LineScanner& line);

/// Reads what follows the keyword `eye`, `look`, `up` or one of a projection into that part of the camera,
/// which must not be there yet (`keyword_location` is where a second one is reported); false if it is another
/// keyword.
bool read_camera_part(std::string_view keyword, const SourceLocation& keyword_location, LineScanner& line,
                      CameraParameters& camera);

/// The projection alone: what is left once the view transform is done.
CameraParameters without_position(const CameraParameters& camera);

/// True if up x (look - eye) is 0, as far as 31 digits can tell.
bool is_parallel_to_view(const Vec3& eye, const Vec3& look, const Vec3& up);

/// An error at its place unless the parts that are there go together: eye and look differ, up is not parallel
/// to the view direction and not 0.
void check_camera(const CameraParameters& camera);

/// The parts of `preferred`, and those of `otherwise` that `preferred` does not have.
CameraParameters merged(const CameraParameters& preferred, const CameraParameters& otherwise);

}  // namespace pipeline
