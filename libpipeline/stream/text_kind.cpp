#include "libpipeline/stream/text_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "libpipeline/scene/scene_commands.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

using Words = std::vector<std::string_view>;

// A scene's camera takes four lines, and a header shows its kind within four.
constexpr std::size_t kLinesLookedAt = 4;

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_position(std::string_view keyword) {
  return is_one_of(keyword, {"eye", "look", "up"});
}

/// True for a line that begins with `count` numbers.
bool begins_with_numbers(const Words& line, std::size_t count) {
  return line.size() >= count &&
         std::all_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(count), begins_like_number);
}

bool is_point(const Words& line) {
  return line.size() == 3 && begins_with_numbers(line, 3);
}

bool is_size(std::string_view word) {
  std::uint64_t size = 0;
  return parse_count(word, size) && size >= 1 && size <= kMaxViewportSize;
}

/// True for a line that only scenes have: a command, but not the `triangle N` of a stage text.
bool is_command(const Words& line) {
  if (line.front() == "triangle") return line.size() != 2;
  const SceneCommand* command = find_scene_command(line.front());
  return command != nullptr && (command->kind == CommandKind::transform ||
                                command->kind == CommandKind::stack || command->kind == CommandKind::color);
}

bool is_scene(const std::vector<Words>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is_command(lines[i])) return true;
    const bool is_projection =
        begins_with_numbers(lines[i], 4) || is_one_of(lines[i].front(), {"ortho", "frustum"});
    if (i == 3) return is_projection;
    if (!is_point(lines[i])) return false;
  }
  return false;
}

bool is_config(const std::vector<Words>& lines) {
  const Words& first = lines.front();
  return first.size() == 2 && is_size(first[0]) && is_size(first[1]) &&
         (lines.size() == 1 || lines[1].size() == 1);
}

/// True for a first word of a model file: OBJ's keywords (its comments look like ours), PLY, STL and glTF.
bool begins_model_file(std::string_view word) {
  return word.front() == '{' || word.substr(0, 4) == "glTF" ||
         is_one_of(word, {"v", "vt", "vn", "f", "o", "g", "s", "mtllib", "usemtl", "ply", "solid"});
}

/// The kind of a text that begins with a header, else unknown. Lines about color and light do not decide: a
/// scene has them, too.
TextKind kind_by_header(const std::vector<Words>& lines) {
  TextKind kind = TextKind::unknown;
  for (const Words& line : lines) {
    const std::string_view keyword = line.front();
    if (keyword == "projected" || (keyword == "attributes" && line.size() > 1 && line[1] == "w"))
      return TextKind::ndc;
    if (is_position(keyword)) return TextKind::world;
    if (is_one_of(keyword, {"perspective", "frustum", "ortho"}))
      kind = TextKind::view;
    else if (keyword != "framed" && !is_setting(keyword))
      break;
  }
  return kind;
}

TextKind kind_by_lines(const std::vector<Words>& lines) {
  if (lines.empty()) return TextKind::unknown;
  if (lines.front().front().find('\x1b') != std::string_view::npos) return TextKind::editor_screen;
  if (begins_model_file(lines.front().front())) return TextKind::model_file;
  if (is_config(lines)) return TextKind::config;
  if (is_scene(lines)) return TextKind::scene;
  if (lines.size() >= 3 && std::all_of(lines.begin(), lines.begin() + 3, is_point))
    return TextKind::triangles;
  return kind_by_header(lines);
}

constexpr std::array kExpected = {"a scene", "the output of model", "the output of view",
                                  "the output of project", "a config"};  // by TextKind

std::string named(TextKind expected) {
  return kExpected[static_cast<std::size_t>(expected)];
}

std::string described(TextKind found, TextKind expected) {
  if (found == TextKind::ndc && expected == TextKind::config)
    return "the output of project: is the config before it missing?";
  if (found == TextKind::triangles && expected != TextKind::scene)
    return "triangles: CONFIG comes before INPUT";
  constexpr std::array kFound = {"a scene: model reads those",
                                 "the output of model: view reads that",
                                 "the output of view: project reads that",
                                 "the output of project: zbuf reads that",
                                 "a config: zbuf reads those",
                                 "triangles without a camera (stage1.txt): view --scene reads those",
                                 "an editor's screen: was Vim's view run in place of ours?",
                                 "a model file: 'pipeline picture' draws it, mesh2scene makes a scene of it"};
  return kFound[static_cast<std::size_t>(found)];
}

/// True if a text of the kind `found` cannot be one of the kind `expected`. Stage texts are distinguished by
/// their whole header, later.
bool excludes(TextKind found, TextKind expected) {
  if (found == expected || found == TextKind::unknown) return false;
  const bool is_of_any_stage = found == TextKind::triangles;
  const bool has_header = found == TextKind::world || found == TextKind::view || found == TextKind::ndc;
  if (expected == TextKind::config) return true;
  if (expected == TextKind::scene) return !is_of_any_stage;
  return !is_of_any_stage && !has_header;
}

/// What a project stage must do with the header line of the projection.
std::string duty_of_project(const StageHeader& header) {
  return header.appearance.lights.empty() ? "drop this line"
                                          : "write 'projected frustum L R B T N F' (or ortho) in its place";
}

struct Beginning {
  TextKind kind = TextKind::unknown;
  LineScanner first_line;
  bool is_one_triangle = false;  // three lines, then a blank one
};

Beginning beginning_of(TextReader& text) {
  std::string_view rest = text.beginning();
  std::vector<Words> lines;
  lines.reserve(kLinesLookedAt);
  LineScanner first;
  bool is_blank_after_three = false;
  for (std::size_t number = 1; !rest.empty() && lines.size() < kLinesLookedAt; ++number) {
    const std::size_t length = std::min(rest.find('\n'), rest.size());
    LineScanner line(rest.substr(0, length), text.file(), number);
    rest.remove_prefix(std::min(length + 1, rest.size()));
    is_blank_after_three |= line.at_end() && lines.size() == 3;
    if (line.at_end()) continue;
    if (lines.empty()) first = line;
    lines.emplace_back().reserve(4);
    while (!line.at_end()) lines.back().push_back(line.word());
  }
  return {kind_by_lines(lines), first, is_blank_after_three};
}

}  // namespace

TextKind kind_of(TextReader& text) {
  return beginning_of(text).kind;
}

void expect_kind(TextReader& text, TextKind expected) {
  const auto [found, first_line, is_one_triangle] = beginning_of(text);
  const bool is_bare = found == TextKind::triangles && expected == TextKind::scene && is_one_triangle;
  if (is_bare || excludes(found, expected))
    throw InputError(first_line.location(),
                     "expected " + named(expected) + ", but this looks like " + described(found, expected));
}

void expect_header(const StageReader& reader, TextKind expected) {
  const StageHeader& header = reader.header();
  const auto refuse = [&](const Located<std::string>& line, const std::string& why) {
    throw InputError(line.location, named(expected), quoted(line.value) + ": " + why);
  };
  for (const Located<std::string>& line : header.camera_lines) {
    const bool is_projected = line.value == "projected";
    if (expected != TextKind::ndc && is_projected) refuse(line, "this text has been through project already");
    if (expected == TextKind::view && is_position(line.value))
      refuse(line,
             "this text has not been through view; a view of your own must drop the lines eye, look and up");
    if (expected == TextKind::ndc && is_position(line.value))
      refuse(
          line,
          "this text has not been through view and project; stages of your own must drop the camera's lines");
    if (expected == TextKind::ndc && !is_projected)
      refuse(line,
             "this text has not been through project; a project of your own must " + duty_of_project(header));
  }
  const std::string_view space = expected == TextKind::world  ? "world"
                                 : expected == TextKind::view ? "view"
                                                              : "ndc";
  if (header.bounds && header.bounds->value.space != space)
    refuse({"bounds " + std::string(header.bounds->value.space), header.bounds->location},
           "a stage before this one has passed on a line that holds for its input");
  if (expected != TextKind::ndc) return expect_no_w(header.appearance);
  if (!header.appearance.lights.empty() && !header.projected)
    throw InputError(reader.header_end(),
                     "a header line 'projected frustum L R B T N F' (or ortho) in a text with lights",
                     "none: this text has not been through project");
}

std::string reason_without_camera(const StageReader& reader) {
  if (reader.header().camera.projection) return ": this text has been through view already";
  return reader.has_body() ? ": this text is bare, or has been through project already" : "";
}

}  // namespace pipeline
