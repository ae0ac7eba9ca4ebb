#pragma once

#include <cstdint>
#include <variant>

#include "libpipeline/camera.h"
#include "libpipeline/text_reader.h"
#include "libpipeline/triangle_batch.h"
#include "libpipeline/vec.h"

namespace pipeline {

// The commands of a scene, as they are written: angles in degrees, no arithmetic done.
struct TriangleCommand {
  Triangle p_model;
  VertexLines lines{};
};
struct TranslateCommand {
  Vec3 offset;
};
struct ScaleCommand {
  Vec3 factors;
};
struct RotateCommand {
  double angle_degrees = 0;
  Vec3 axis;
};
struct PushCommand {};
struct PopCommand {};
struct EndCommand {};

using Command = std::variant<TriangleCommand, TranslateCommand, ScaleCommand, RotateCommand, PushCommand,
                             PopCommand, EndCommand>;

/// Reads scene.txt: the camera on construction, then command after command. Errors are InputErrors.
///
///     eyeX eyeY eyeZ
///     lookX lookY lookZ
///     upX upY upZ
///     fovY aspect near far         or: ortho L R B T N F, or: frustum L R B T N F
///     triangle | translate | scale | rotate | push | pop, each with its arguments
///     end
class SceneReader {
 public:
  explicit SceneReader(TextReader& text);

  /// The camera, complete and checked.
  [[nodiscard]] const CameraText& camera() const { return camera_; }
  /// The next command. After EndCommand nothing may be read.
  Command next();
  /// The place of the command given out last.
  [[nodiscard]] const Place& place() const { return place_; }
  /// True if the next command can be had without waiting for the input, whatever it is: none has more than
  /// four lines.
  [[nodiscard]] bool has_command_waiting() const { return text_.has_lines_waiting(4); }

 private:
  Placed<Vec3> read_camera_vec3(const std::string& name);
  Placed<Projection> read_camera_projection();
  void next_argument_line(std::string_view expected);
  TriangleCommand read_triangle();
  RotateCommand read_rotation();

  TextReader& text_;
  CameraText camera_;
  LineScanner line_;
  Place place_;
};

}  // namespace pipeline
