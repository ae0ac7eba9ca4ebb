#pragma once

#include <cstddef>
#include <string>
#include <variant>

#include "libpipeline/numbers/vec.h"
#include "libpipeline/scene/appearance.h"
#include "libpipeline/scene/camera.h"
#include "libpipeline/text/source_location.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

struct SceneCommand;

// The commands of a scene as they are written: angles in degrees, before any arithmetic.
struct TriangleCommand {
  Triangle p_model;
  VertexLocations locations;
};
/// A sphere; SceneReader::lines has its color and material.
struct SphereCommand {
  Vec3 center;  // in model space
  double radius = 0;
  LineAndColumn center_location;
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
/// A change of the appearance, the current color or the current material; the reader holds their values.
struct AppearanceCommand {};
struct LightCommand {
  Located<Light> light;  // in model space
};

using Command = std::variant<TriangleCommand, SphereCommand, TranslateCommand, ScaleCommand, RotateCommand,
                             PushCommand, PopCommand, EndCommand, AppearanceCommand, LightCommand>;

/// Reads scene.txt: the camera on construction, then command after command. Errors are InputErrors.
///
///     eyeX eyeY eyeZ
///     lookX lookY lookZ
///     upX upY upZ
///     fovY aspect near far [ratio] or: ortho L R B T N F, or: frustum L R B T N F
///     triangle | sphere | translate | scale | rotate | push | pop, each with its arguments
///     end
///
/// Before the first object, only where a scene needs them:
///
///     attributes [color] [normal]  vertex lines carry x y z [r g b] [nx ny nz]
///     color r g b                  of the triangles that follow; may change later if it stands here
///     background r g b [a] | ambient r g b | light x y z r g b
///     material ambient diffuse specular shininess [reflectance index alpha]
///     absorption r g b             of the last material, inside, per unit length
///     paint r g b                  of the last material: its triangles' color where there is no other
///     attenuation constant linear quadratic
///
/// Materials may repeat and are numbered from 0; `use K`, anywhere, gives the triangles that follow material
/// K.
class SceneReader {
 public:
  explicit SceneReader(TextReader& text);

  /// The camera, complete and checked.
  [[nodiscard]] const CameraParameters& camera() const { return camera_; }
  /// The appearance read so far, without the lights, which are commands. Complete at the first triangle; its
  /// columns are the attributes of all triangles.
  [[nodiscard]] const Appearance& appearance() const { return appearance_; }
  /// The vertex lines of the triangle that `next` returned last, with the attributes in `appearance()` and
  /// the current material; after a sphere, its color three times. Undefined if there are none.
  [[nodiscard]] const TriangleLines& lines() const { return lines_; }
  /// Reads the next command; not to be called after EndCommand.
  Command next();
  /// The fast path: adds the next triangles to the arrays, at most `limit`, as long as they are completely
  /// buffered and read_columns (fixed_text.h) reads them. Returns their count; each has four lines, from
  /// `first_line` on. 0 if another command comes next, or a triangle in another form.
  std::size_t read_buffered(std::size_t limit, std::vector<Triangle>& p_model, AttributeArrays& attributes,
                            std::size_t& first_line);
  /// The location of the command that `next` returned last, unless that is a triangle.
  [[nodiscard]] const SourceLocation& location() const { return location_; }
  /// True if the next command is buffered: no command has more than four lines.
  [[nodiscard]] bool has_buffered_command() const { return text_.has_buffered_lines(4); }

 private:
  TriangleCommand read_triangle();
  void read_vertex(std::size_t index);
  [[nodiscard]] bool is_allowed(const SceneCommand& command) const;
  [[noreturn]] void refuse(const SceneCommand* command) const;
  [[nodiscard]] std::string expected_commands() const;
  AppearanceCommand read_current_color();
  Command read_setting(std::string_view word);
  AppearanceCommand read_use();
  RotateCommand read_rotation();
  SphereCommand read_sphere();

  TextReader& text_;
  CameraParameters camera_;
  Appearance appearance_;
  VertexLineReader vertex_line_;
  Vec3 current_color_;
  bool has_current_color_ = false;
  TriangleLines lines_;  // its material is the current one
  bool has_triangle_ = false;
  LineScanner line_;
  SourceLocation location_;
};

}  // namespace pipeline
