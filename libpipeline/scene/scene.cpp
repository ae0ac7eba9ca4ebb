#include "libpipeline/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

constexpr std::array<std::string_view, 18> kCommands = {
    "triangle", "sphere",   "translate",  "scale",      "rotate",      "push",
    "pop",      "end",      "color",      "attributes", "background",  "light",
    "ambient",  "material", "absorption", "paint",      "attenuation", "use"};

}  // namespace

SceneReader::SceneReader(TextReader& text) : text_(text) {
  camera_.eye = read_camera_vec3("the eye");
  camera_.look = read_camera_vec3("the point looked at");
  camera_.up = read_camera_vec3("the up direction");
  camera_.projection = read_camera_projection();
  check_camera(camera_);
}

Located<Vec3> SceneReader::read_camera_vec3(const std::string& name) {
  next_argument_line(name + " (three numbers)");
  const SourceLocation location = line_.location();
  return {line_.vec3(name), location};
}

Located<Projection> SceneReader::read_camera_projection() {
  next_argument_line("fovY aspect near far (or: ortho L R B T N F, or: frustum L R B T N F)");
  const std::string_view first = line_.peek();
  const bool is_named = first == "ortho" || first == "frustum";
  if (is_named) line_.word();
  const SourceLocation location = line_.location();
  return {read_projection(is_named ? first : "perspective", line_), location};
}

/// Moves on to the next line that is not blank, unless a word is left on the command's own line.
void SceneReader::next_argument_line(std::string_view expected) {
  if (line_.at_end() && !text_.next_filled_line(line_))
    throw InputError(text_.end_location(), expected_but_found(std::string(expected), "the end of the input"));
}

std::size_t SceneReader::read_buffered(std::size_t limit, std::vector<Triangle>& p_model,
                                       AttributeArrays& attributes, std::size_t& first_line) {
  static_assert(TextReader::kSlack >= kFixedTextSlack);
  if (!line_.at_end()) return 0;
  // A blank line between triangles.
  if (text_.buffered().starts_with('\n')) text_.skip(1, 1);
  const std::string_view text = text_.buffered();
  if (!text.starts_with("triangle\n")) return 0;
  std::array<DecimalMarks, 24> marks;
  const FixedTextPart part =
      vertex_line_.read_triangles(text, TriangleFrame::scene, limit, marks, p_model, attributes);
  const bool has_current_color = appearance_.columns().color && !vertex_line_.attributes().color;
  if (has_current_color)
    attributes.colors.resize(p_model.size(), {current_color_, current_color_, current_color_});
  if (appearance_.columns().material) attributes.materials.resize(p_model.size(), lines_.material);
  first_line = text_.line_number() + 1;
  text_.skip(part.length, 4 * part.triangle_count);
  if (part.triangle_count > 0) has_triangle_ = true;
  return part.triangle_count;
}

// S10
Command SceneReader::next() {
  if (!text_.next_filled_line(line_))
    throw InputError(text_.end_location(),
                     expected_but_found("'end', which closes a scene", "the end of the input"));
  location_ = line_.location();
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
  if (keyword == "sphere") return read_sphere();
  if (keyword == "use") return read_use();
  if (keyword == "push") return takes_no_arguments(), PushCommand{};
  if (keyword == "pop") return takes_no_arguments(), PopCommand{};
  if (keyword == "end") {
    takes_no_arguments();
    if (text_.next_filled_line(line_)) line_.fail("nothing after 'end'");
    return EndCommand{};
  }
  if (keyword == "color" || is_appearance_keyword(keyword)) return read_appearance(keyword);
  const bool is_vertex = has_triangle_ && begins_like_number(keyword);
  const bool is_normal = keyword == "normal" || keyword == "vn";
  line_.fail(expected_commands(), is_vertex ? " (a triangle has three vertices)"
                                  : is_normal
                                      ? " (normals are columns of vertex lines, after 'attributes normal')"
                                      : spelling_hint(keyword, kCommands));
}

/// The commands that are allowed here.
std::string SceneReader::expected_commands() const {
  std::string commands = "a command (triangle, sphere, translate, scale, rotate, push, pop or end";
  if (!has_triangle_)
    commands +=
        "; before the first triangle also color, attributes, background, light, ambient, material or "
        "attenuation";
  std::string others;
  const auto add = [&](const char* command) {
    others += (others.empty() ? "; also " : " and ") + std::string(command);
  };
  if (has_triangle_ && appearance_.columns().color) add("color");
  if (!has_triangle_ && !appearance_.materials.empty()) add("absorption and paint");
  if (appearance_.materials.size() > 1) add("use");
  return commands + others + ")";
}

/// Reads a color or light command. All but `color` must come before the first triangle.
Command SceneReader::read_appearance(std::string_view keyword) {
  const bool is_color = keyword == "color";
  if (has_triangle_ && !(is_color && appearance_.columns().color)) {
    const std::string expected = is_color ? "'color' or 'attributes color' before the first triangle, too"
                                          : quoted(keyword) + " before the first triangle";
    throw InputError(location_, expected_but_found(expected, quoted(keyword) + " after it"));
  }
  const std::string name(line_.word());
  next_argument_line("the arguments of " + quoted(name));
  if (is_color) return read_current_color(), AppearanceCommand{};
  const AttributeSet had = appearance_.columns();
  if (name == "attributes" && !vertex_line_.attributes().any()) appearance_.attributes.reset();
  read_appearance_part(name, location_, line_, AttributeSource::scene, appearance_);
  if (name == "light") {
    const LightCommand command{appearance_.lights.back()};
    appearance_.lights.clear();
    return command;
  }
  if (name == "attributes") {
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

void SceneReader::read_current_color() {
  current_color_ = read_color(line_, "the color");
  has_current_color_ = true;
  line_.expect_end("the blue of the color");
  if (!appearance_.attributes) appearance_.attributes = {{}, location_};
  appearance_.attributes->value.color = true;
}

/// Reads `use K`; material 0 is there without a line, too.
// S23
Command SceneReader::read_use() {
  line_.word();
  next_argument_line("the arguments of 'use'");
  const std::size_t count = std::max<std::size_t>(appearance_.materials.size(), 1);
  const LineScanner at_number = line_;
  const std::string expected =
      "the number of a material above, a whole number below " + std::to_string(count);
  const std::uint64_t material = line_.count(expected);
  if (material >= count) at_number.fail(expected);
  line_.expect_end("the number of a material");
  lines_.material = static_cast<std::uint32_t>(material);
  return AppearanceCommand{};
}

/// Takes a vertex line of a scene with attributes; a color without columns is the current one.
void SceneReader::read_vertex(std::size_t index) {
  LineScanner at_normal = line_;
  vertex_line_.read(line_, index, lines_);
  VertexLine& vertex = lines_.vertices[index];
  if (!vertex_line_.attributes().color) vertex.color = current_color_;
  if (vertex_line_.attributes().normal && vertex.normal == Vec3{}) {
    for (int i = vertex_line_.attributes().color ? 6 : 3; i > 0; --i) at_normal.word();
    throw InputError(
        at_normal.location(),
        expected_but_found("a normal of " + std::string(kVertexNames[index]) + " other than 0 0 0", "0 0 0"));
  }
}

// S11
TriangleCommand SceneReader::read_triangle() {
  line_.word();
  has_triangle_ = true;
  const bool has_attributes = appearance_.attributes.has_value();
  TriangleCommand command;
  for (std::size_t i = 0; i < 3; ++i) {
    next_argument_line(kVertexNames[i]);
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

/// Reads `sphere` and its center and radius. The points of its surface that stage texts carry have to be
/// numbers, and not the center.
// S24
SphereCommand SceneReader::read_sphere() {
  line_.word();
  next_argument_line("a center and a radius (four numbers)");
  has_triangle_ = true;
  const AttributeSet& columns = appearance_.columns();
  if (columns.color && vertex_line_.attributes().color && !has_current_color_)
    throw InputError(location_, expected_but_found("'color' before a sphere, which has no columns of its own",
                                                   "'attributes color' alone"));
  SphereCommand command;
  command.center_location = {line_.line_number(), line_.column()};
  Vec3& center = command.center;
  center.x = line_.number("the x of the center");
  center.y = line_.number("the y of the center");
  center.z = line_.number("the z of the center");
  const auto is_seen_in = [](double coordinate, double radius) {
    return std::isfinite(coordinate + radius) && coordinate + radius > coordinate;
  };
  command.radius = number_where(
      line_, {"a radius"}, "above 0 that changes the coordinates of the center", [&](double radius) {
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
  line_.word();
  next_argument_line("an angle and an axis (four numbers)");
  RotateCommand command;
  command.angle_degrees = line_.number("an angle in degrees");
  const SourceLocation axis_location = line_.location();
  command.axis = line_.vec3("the axis");
  if (command.axis == Vec3{}) throw InputError(axis_location, expected_but_found("a rotation axis", "0 0 0"));
  return command;
}

}  // namespace pipeline
