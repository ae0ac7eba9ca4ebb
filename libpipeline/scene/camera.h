#pragma once

#include <optional>
#include <string_view>
#include <variant>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/header_line.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// The rule for the horizontal field of view: `angle`, the course's fovX = fovY * aspect, or `ratio`,
/// gluPerspective's tan(fovX / 2) = tan(fovY / 2) * aspect.
enum class AspectRule { angle, ratio };

/// gluPerspective's parameters. `near` and `far` are distances from the eye along the view direction,
/// 0 < near < far.
struct Perspective {
  double fov_y_degrees = 0;  // above 0, below 180
  double aspect = 1;         // width by height, above 0
  double near = 0;
  double far = 0;
  AspectRule aspect_rule = AspectRule::angle;
};

/// glFrustum's parameters: the window on the near plane, in x and y of view space, and 0 < near < far.
/// left != right and bottom != top; a descending pair mirrors its axis.
struct Frustum {
  double left = 0, right = 0, bottom = 0, top = 0, near = 0, far = 0;
};

/// glOrtho's parameters: the bounds of the view volume in x and y of view space, under the same conditions as
/// a Frustum's, and near < far, distances that may have any sign.
struct Orthographic {
  double left = 0, right = 0, bottom = 0, top = 0, near = 0, far = 0;
};

using Projection = std::variant<Perspective, Frustum, Orthographic>;

/// The camera parameters that were given, each with the location of its numbers; nullopt for the parts that a
/// scene, a stage text's header or the options leave out.
struct CameraParameters {
  std::optional<Located<Vec3>> eye;   // a point in world space
  std::optional<Located<Vec3>> look;  // the point looked at, in world space
  std::optional<Located<Vec3>> up;    // a direction of any length but 0, in world space
  std::optional<Located<Projection>> projection;
};

/// Reads the numbers after the keyword `perspective`, `frustum` or `ortho`, to the end of the line. A
/// perspective's numbers may be followed by the name of its aspect rule. An InputError at a number that is
/// missing or breaks a condition of its struct above.
Projection read_projection(std::string_view keyword, LineScanner& line);

/// Reads the numbers after the keyword `eye`, `look`, `up`, `perspective`, `frustum` or `ortho`, to the end
/// of the line, into `camera`; false, with nothing read, for another keyword. An InputError at
/// `keyword_location` if the camera has that part already.
bool read_camera_part(std::string_view keyword, const SourceLocation& keyword_location, LineScanner& line,
                      CameraParameters& camera);

/// True if up x (look - eye) is 0 as far as 31 digits can tell.
bool is_parallel_to_view(const Vec3& eye, const Vec3& look, const Vec3& up);

/// Checks the parts that are given: an InputError at `look` if it equals the eye, and at `up` if it is 0 or
/// parallel to the view direction.
void check_camera(const CameraParameters& camera);

/// `preferred`, with its missing parts taken from `otherwise`.
CameraParameters merged(const CameraParameters& preferred, const CameraParameters& otherwise);

}  // namespace pipeline
