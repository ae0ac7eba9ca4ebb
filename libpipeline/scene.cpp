#include "libpipeline/scene.h"

#include <string_view>

namespace pipeline {
SceneReader::SceneReader(TextReader& text) : text_(text) {
  camera_.eye = read_camera_vec3("the eye");
  camera_.look = read_camera_vec3("the point looked at");
  camera_.up = read_camera_vec3("the up direction");
  camera_.projection = read_camera_projection();
  check_camera(camera_);
}

Placed<Vec3> SceneReader::read_camera_vec3(const std::string& name) {
  next_argument_line(name + " (three numbers)");
  const Place place = line_.place();
  return {line_.vec3(name), place};
}

Placed<Projection> SceneReader::read_camera_projection() {
  next_argument_line("fovY aspect near far (or: ortho L R B T N F, or: frustum L R B T N F)");
  const std::string_view first = line_.peek();
  const bool is_named = first == "ortho" || first == "frustum";
  if (is_named) line_.word();
  const Place place = line_.place();
  return {read_projection(is_named ? first : "perspective", line_), place};
}

/// Moves on to the next line that is not blank, unless the command's own line still holds something.
void SceneReader::next_argument_line(std::string_view expected) {
  if (line_.at_end() && !text_.next_filled_line(line_))
    throw InputError(text_.end_place(), expected_but_found(std::string(expected), "the end of the input"));
}

Command SceneReader::next() {
  if (!text_.next_filled_line(line_))
    throw InputError(text_.end_place(),
                     expected_but_found("'end', which closes a scene", "the end of the input"));
  place_ = line_.place();
  const std::string_view keyword = line_.peek();
  const auto takes_no_arguments = [&] {
    line_.word();
    line_.expect_end(quoted(keyword));
  };
  if (keyword == "triangle") return read_triangle();
  if (keyword == "translate" || keyword == "scale") {
    const bool is_scale = keyword == "scale";
    line_.word();
    next_argument_line(is_scale ? "three factors" : "three distances");
    if (is_scale) return ScaleCommand{line_.vec3("the scale")};
    return TranslateCommand{line_.vec3("the translation")};
  }
  if (keyword == "rotate") return read_rotation();
  if (keyword == "push") return takes_no_arguments(), PushCommand{};
  if (keyword == "pop") return takes_no_arguments(), PopCommand{};
  if (keyword == "end") {
    takes_no_arguments();
    if (text_.next_filled_line(line_)) line_.fail("nothing after 'end'");
    return EndCommand{};
  }
  line_.fail("a command (triangle, translate, scale, rotate, push, pop or end)");
}

TriangleCommand SceneReader::read_triangle() {
  line_.word();
  TriangleCommand command;
  for (std::size_t i = 0; i < 3; ++i) {
    next_argument_line(kVertexNames[i]);
    command.p_model[i] = line_.vec3(kVertexNames[i]);
    command.lines[i] = line_.line_number();
  }
  return command;
}

RotateCommand SceneReader::read_rotation() {
  line_.word();
  next_argument_line("an angle and an axis (four numbers)");
  RotateCommand command;
  command.angle_degrees = line_.number("an angle in degrees");
  const Place axis_place = line_.place();
  command.axis = line_.vec3("the axis");
  if (command.axis == Vec3{}) throw InputError(axis_place, expected_but_found("a rotation axis", "0 0 0"));
  return command;
}

}  // namespace pipeline
