#include "libpipeline/scene/scene_cutter.h"

#include <algorithm>

#include "libpipeline/scene/scene_commands.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

constexpr std::string_view kTriangle = "triangle\n", kPush = "push\n", kPop = "pop\n";

/// The length of a triangle at the beginning of `text` whose keyword and vertices are on separate lines; 0 if
/// there is none.
std::size_t length_of_triangle(std::string_view text) {
  if (!text.starts_with(kTriangle)) return 0;
  std::size_t end = kTriangle.size();
  for (int vertex = 0; vertex < 3; ++vertex) {
    if (!begins_like_number(text.substr(std::min(end, text.size()), 1))) return 0;
    end = text.find('\n', end) + 1;
    if (end == 0) return 0;
  }
  return end;
}

void write_repeated(TextWriter& part, std::string_view command, std::uint64_t count) {
  for (; count > 0; --count) part.append(command);
}

}  // namespace

SceneCutter::SceneCutter(TextReader& text) : text_(text) {
  for (int camera_line = 0; camera_line < 4; ++camera_line) {
    text_.expect_filled_line(line_, "the four lines of the camera");
    (preamble_.back().text += line_.rest()) += '\n';
  }
  find_triangle(nullptr);
  is_in_preamble_ = false;
  depth_of_preamble_ = depth_kept_ = depth_;
  for (Commands& level : levels_) level.in_preamble = level.text.size();
}

void SceneCutter::add_push(std::vector<Commands>& commands) {
  if (!commands.back().text.empty()) commands.emplace_back();
  ++commands.back().push_count;
}

void SceneCutter::begin(TextWriter& part) const {
  for (const Commands& commands : preamble_) {
    write_repeated(part, kPush, commands.push_count);
    part.append(commands.text);
  }
  write_repeated(part, kPop, depth_of_preamble_ - depth_kept_);
  std::uint64_t depth = 0;
  for (const Commands& level : levels_) {
    const std::uint64_t depth_before = depth;
    depth += level.push_count;
    if (depth < depth_kept_) continue;
    write_repeated(part, kPush, depth - std::max(depth_before, depth_kept_));
    part.append(std::string_view(level.text).substr(depth == depth_kept_ ? level.in_preamble : 0));
  }
  part.append(color_);
  part.append(material_);
}

void SceneCutter::copy(TextWriter& part, std::size_t end) {
  do {
    if (line_is_pending_)
      copy_triangle(part);
    else
      copy_buffered(part, end);
    find_triangle(&part);
  } while (has_triangle_ && position() < end);
}

/// Copies the commands before the next triangle, or before the scene's end.
void SceneCutter::find_triangle(TextWriter* part) {
  has_triangle_ = true;
  while (true) {
    while (text_.buffered().starts_with('\n')) text_.skip(1, 1);
    if (length_of_triangle(text_.buffered()) > 0) return;
    text_.expect_filled_line(line_, "'end', which closes a scene");
    const SceneCommand* command = find_scene_command(line_.peek());
    line_is_pending_ = command != nullptr && command->kind == CommandKind::object;
    if (line_is_pending_) return;
    if (line_.peek() == "end") {
      line_.word();
      line_.expect_end("'end'");
      if (text_.next_filled_line(line_)) line_.fail("nothing after 'end'");
      has_triangle_ = false;
      return;
    }
    carry_out(part);
  }
}

/// Copies the command on this line, other than a triangle, to `part` or, if that is null, to the preamble.
void SceneCutter::carry_out(TextWriter* part) {
  const LineScanner at_keyword = line_;
  const CommandKind kind = expect_allowed(at_keyword).kind;
  const std::string keyword(line_.word());
  std::string command = keyword + "\n";
  if (keyword == "push") {
    line_.expect_end("'push'");
    add_push(levels_);
    ++depth_;
  } else if (keyword == "pop") {
    line_.expect_end("'pop'");
    pop(at_keyword);
  } else {
    text_.expect_word(line_, "the arguments of ", keyword);
    (command += line_.rest()) += '\n';
    if (kind == CommandKind::transform)
      levels_.back().text += command;
    else if (kind == CommandKind::color && !is_in_preamble_)
      color_ = command;
    else if (kind == CommandKind::use && !is_in_preamble_)
      material_ = command;
    has_color_ |= kind == CommandKind::color ||
                  (keyword == "attributes" && line_.rest().find("color") != std::string_view::npos);
  }
  if (part != nullptr)
    part->append(command);
  else if (keyword == "push")
    add_push(preamble_);
  else
    preamble_.back().text += command;
}

void SceneCutter::pop(const LineScanner& at_pop) {
  if (depth_ == 0) throw InputError(at_pop.location(), "a matrix that 'push' has saved", "'pop' without one");
  levels_.back() = {levels_.back().push_count - 1};
  if (levels_.back().push_count == 0 && levels_.size() > 1) levels_.pop_back();
  depth_kept_ = std::min(depth_kept_, --depth_);
}

/// Returns the command, or throws: a setting after the first object would apply to some parts only.
const SceneCommand& SceneCutter::expect_allowed(const LineScanner& at_keyword) const {
  const SceneCommand* command = find_scene_command(at_keyword.peek());
  if (command == nullptr) at_keyword.fail("a command of a scene");
  const bool is_color = command->kind == CommandKind::color;
  if (is_in_preamble_ || !(is_color || command->is_setting()) || (is_color && has_color_)) return *command;
  throw InputError(at_keyword.location(), quoted(command->word) + " before the first object",
                   quoted(command->word) + " after it");
}

/// Copies the triangle or sphere whose first line is `line_`.
void SceneCutter::copy_triangle(TextWriter& part) {
  line_is_pending_ = false;
  const std::string keyword(line_.word());
  part.append(keyword + "\n");
  for (int count = find_scene_command(keyword)->argument_lines; count > 0; --count) {
    text_.expect_word(line_, "the arguments of ", keyword);
    part.append(line_.rest());
    part.append("\n");
    line_ = LineScanner();
  }
  ++next_number_;
}

/// Copies at least one of the next triangles, which are buffered.
void SceneCutter::copy_buffered(TextWriter& part, std::size_t end) {
  const std::string_view text = text_.buffered();
  const std::size_t room = end > position() ? end - position() : 1;
  std::size_t length = 0, line_count = 0;
  while (length < room) {
    const std::size_t blank = text.substr(length).starts_with('\n') ? 1 : 0;
    const std::size_t of_triangle = length_of_triangle(text.substr(length + blank));
    if (of_triangle == 0) break;
    length += blank + of_triangle;
    line_count += blank + 4;
    ++next_number_;
  }
  part.append(text.substr(0, length));
  text_.skip(length, line_count);
}

}  // namespace pipeline
