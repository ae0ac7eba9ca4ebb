#include "libpipeline/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "libpipeline/scene/scene_commands.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {

SceneReader::SceneReader(TextReader& text) : text_(text) {
  text_.expect_word(line_, "the eye (three numbers)");
  // A word that begins with a letter and is no command of ours: another program's scene.
  if (const auto w = line_.peek(); w.size() > 1 && w >= "A" && w < "{" && !find_scene_command(w))
    line_.fail("the x of the eye", " (a scene begins with numbers: pipeline help scene)");
  const auto read = [&](std::string_view keyword) { read_camera_part(keyword, location_, line_, camera_); };
  read("eye");
  text_.expect_word(line_, "the point looked at (three numbers)");
  read("look");
  text_.expect_word(line_, "the up direction (three numbers)");
  read("up");
  text_.expect_word(line_, "fovY aspect near far (or: ortho L R B T N F, or: frustum L R B T N F)");
  const std::string_view first = line_.peek();
  const bool is_named = first == "ortho" || first == "frustum";
  if (is_named) line_.word();
  read(is_named ? first : "perspective");
  check_camera(camera_);
}

std::size_t SceneReader::read_buffered(std::size_t limit, std::vector<Triangle>& p_model,
                                       AttributeArrays& attributes, std::size_t& first_line) {
  static_assert(TextReader::kSlack >= kFixedTextSlack);
  if (!line_.at_end()) return 0;
  // Skips a blank line between triangles.
  if (text_.buffered().starts_with('\n')) text_.skip(1, 1);
  const std::string_view text = text_.buffered();
  if (!text.starts_with("triangle\n")) return 0;
  std::array<DecimalMarks, 24> marks;
  const FixedTextPart part =
      vertex_line_.read_triangles(text, TriangleFrame::scene, limit, marks, p_model, attributes);
  if (appearance_.columns().color && !vertex_line_.attributes().color)
    attributes.colors.resize(p_model.size(), {current_color_, current_color_, current_color_});
  if (appearance_.columns().material) attributes.materials.resize(p_model.size(), lines_.material);
  first_line = text_.line_number() + 1;
  text_.skip(part.length, 4 * part.triangle_count);
  if (part.triangle_count > 0) has_triangle_ = true;
  return part.triangle_count;
}

// S10
Command SceneReader::next() {
  text_.expect_filled_line(line_, "'end', which closes a scene");
  location_ = line_.location();
  const SceneCommand* command = find_scene_command(line_.peek());
  if (command == nullptr || !is_allowed(*command)) refuse(command);
  const auto& [word, kind, argument_lines, arguments] = *command;
  line_.word();
  if (argument_lines == 0)
    line_.expect_end(quoted(word));
  else if (argument_lines == 1)  // messages name a triangle's lines differently
    arguments.empty() ? text_.expect_word(line_, "the arguments of ", word)
                      : text_.expect_word(line_, arguments);
  switch (kind) {
    case CommandKind::object:
      if (word == "sphere") return read_sphere();
      return read_triangle();
    case CommandKind::transform:
      if (word == "translate") return TranslateCommand{line_.vec3("the translation")};
      if (word == "scale") return ScaleCommand{line_.vec3("the scale")};
      return read_rotation();
    case CommandKind::stack:
      if (word == "push") return PushCommand{};
      return PopCommand{};
    case CommandKind::end:
      if (text_.next_filled_line(line_)) line_.fail("nothing after 'end'");
      return EndCommand{};
    case CommandKind::color:
      return read_current_color();
    case CommandKind::use:
      return read_use();
    default:
      return read_setting(word);
  }
}

bool SceneReader::is_allowed(const SceneCommand& command) const {
  if (!has_triangle_ || command.kind <= CommandKind::end || command.kind == CommandKind::use) return true;
  return command.kind == CommandKind::color && appearance_.columns().color;
}

/// Throws the error of the next word: a command that is not allowed here, or, if null, no command.
void SceneReader::refuse(const SceneCommand* command) const {
  const std::string_view word = line_.peek();
  if (command == nullptr) {
    line_.fail(expected_commands(),
               has_triangle_ && begins_like_number(word) ? " (a triangle has three vertices)"
               : word == "normal" || word == "vn"
                   ? " (normals are columns of vertex lines, after 'attributes normal')"
                   : spelling_hint(word, scene_words([](const SceneCommand&) { return true; })));
  }
  const std::string expected = command->kind == CommandKind::color
                                   ? "'color' or 'attributes color' before the first object, too"
                                   : quoted(word) + " before the first object";
  throw InputError(location_, expected, quoted(word) + " after it");
}

/// The commands that are allowed here.
std::string SceneReader::expected_commands() const {
  const auto is_of_all = [](const SceneCommand& command) { return command.kind <= CommandKind::end; };
  const auto comes_first = [](const SceneCommand& command) {
    return command.kind == CommandKind::color || command.kind == CommandKind::setting;
  };
  const std::vector<std::string_view> others = scene_words([&](const SceneCommand& command) {
    if (command.kind == CommandKind::color) return has_triangle_ && appearance_.columns().color;
    if (command.kind == CommandKind::of_material) return !has_triangle_ && !appearance_.materials.empty();
    return command.kind == CommandKind::use && appearance_.materials.size() > 1;
  });
  std::string commands = "a command (" + listed(scene_words(is_of_all));
  if (!has_triangle_) commands += "; before the first object also " + listed(scene_words(comes_first));
  for (const std::string_view word : others)
    commands.append(word == others.front() ? "; also " : " and ").append(word);
  return commands + ")";
}

/// Reads a color or light command.
Command SceneReader::read_setting(std::string_view word) {
  const AttributeSet had = appearance_.columns();
  if (word == "attributes" && !vertex_line_.attributes().any()) appearance_.attributes.reset();
  read_appearance_part(word, location_, line_, AttributeSource::scene, appearance_);
  if (word == "light") {
    const LightCommand command{appearance_.lights.back()};
    appearance_.lights.clear();
    return command;
  }
  if (word == "attributes") {
    vertex_line_ = VertexLineReader(appearance_.columns());
    appearance_.attributes->value.color |= had.color;
    appearance_.attributes->value.material = had.material;
  }
  if (appearance_.materials.size() > 1) {
    if (!appearance_.attributes) appearance_.attributes = {{}, location_};
    appearance_.attributes->value.material = true;
  }
  return AppearanceCommand{};
}

AppearanceCommand SceneReader::read_current_color() {
  current_color_ = read_color(line_, "the color");
  has_current_color_ = true;
  line_.expect_end("the blue of the color");
  if (!appearance_.attributes) appearance_.attributes = {{}, location_};
  appearance_.attributes->value.color = true;
  return {};
}

/// Reads `use K`; material 0 always exists, even without a line `material`.
// S23
AppearanceCommand SceneReader::read_use() {
  const std::size_t count = std::max<std::size_t>(appearance_.materials.size(), 1);
  const LineScanner at_number = line_;
  const std::string expected =
      "the number of a material above, a whole number below " + std::to_string(count);
  const std::uint64_t material = line_.count(expected);
  if (material >= count) at_number.fail(expected);
  line_.expect_end("the number of a material");
  lines_.material = static_cast<std::uint32_t>(material);
  return {};
}

/// Takes a vertex line of a scene with attributes; without color columns, the color is the current one.
void SceneReader::read_vertex(std::size_t index) {
  LineScanner at_normal = line_;
  vertex_line_.read(line_, index, lines_);
  VertexLine& vertex = lines_.vertices[index];
  if (!vertex_line_.attributes().color) vertex.color = current_color_;
  if (vertex_line_.attributes().normal && vertex.normal == Vec3{}) {
    for (int i = vertex_line_.attributes().color ? 6 : 3; i > 0; --i) at_normal.word();
    throw InputError(at_normal.location(),
                     "a normal of " + std::string(kVertexNames[index]) + " other than 0 0 0", "0 0 0");
  }
}

// S11
TriangleCommand SceneReader::read_triangle() {
  has_triangle_ = true;
  const bool has_attributes = appearance_.attributes.has_value();
  TriangleCommand command;
  for (std::size_t i = 0; i < 3; ++i) {
    text_.expect_word(line_, kVertexNames[i]);
    command.locations[i] = {line_.line_number(), line_.column()};
    if (has_attributes) {
      read_vertex(i);
      command.p_model[i] = lines_.vertices[i].position;
    } else {
      command.p_model[i] = line_.vec3(kVertexNames[i]);
    }
  }
  return command;
}

/// Reads a sphere's center and radius. The points on its surface in stage texts must be finite and differ
/// from the center.
// S24
SphereCommand SceneReader::read_sphere() {
  has_triangle_ = true;
  const AttributeSet& columns = appearance_.columns();
  if (columns.color && vertex_line_.attributes().color && !has_current_color_)
    throw InputError(location_, "'color' before a sphere, which has no columns of its own",
                     "'attributes color' alone");
  SphereCommand command;
  command.center_location = {line_.line_number(), line_.column()};
  Vec3& center = command.center;
  center = line_.point("the center");
  const auto is_seen_in = [](double coordinate, double radius) {
    return std::isfinite(coordinate + radius) && coordinate + radius > coordinate;
  };
  command.radius = number_where(
      line_, "a radius", "above 0 that changes the coordinates of the center", [&](double radius) {
        return is_seen_in(center.x, radius) && is_seen_in(center.y, radius) && is_seen_in(center.z, radius);
      });
  line_.expect_end("the radius of the sphere");
  VertexLine of_sphere;
  of_sphere.color = current_color_;
  lines_.vertices.fill(of_sphere);
  return command;
}

// S12
RotateCommand SceneReader::read_rotation() {
  RotateCommand command;
  command.angle_degrees = line_.number("an angle in degrees");
  const SourceLocation axis_location = line_.location();
  command.axis = line_.vec3("the axis");
  if (command.axis == Vec3{}) throw InputError(axis_location, "a rotation axis", "0 0 0");
  return command;
}

}  // namespace pipeline
