#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace pipeline {

/// A command's part in a scene, which decides where it is allowed.
enum class CommandKind {
  object,       // anywhere
  transform,    // anywhere: M = M * T
  stack,        // anywhere
  end,          // last
  color,        // before the first object; if it or `attributes color` is there, anywhere
  setting,      // before the first object; in the header of a stage text
  of_material,  // a setting of the material above it
  use           // anywhere; useful only with two or more materials
};

struct SceneCommand {
  std::string_view word;
  CommandKind kind;
  int argument_lines;          // only the first may stand on the command's own line
  std::string_view arguments;  // as messages name them; empty: "the arguments of 'WORD'"

  [[nodiscard]] bool is_setting() const {
    return kind == CommandKind::setting || kind == CommandKind::of_material;
  }
};

/// The commands of a scene, in the order in which messages list them. All code that reads, cuts or names
/// commands goes by these rows.
inline constexpr std::array<SceneCommand, 18> kSceneCommands = {{
    {"triangle", CommandKind::object, 3, ""},
    {"sphere", CommandKind::object, 1, "a center and a radius (four numbers)"},
    {"translate", CommandKind::transform, 1, "three distances"},
    {"scale", CommandKind::transform, 1, "three factors"},
    {"rotate", CommandKind::transform, 1, "an angle and an axis (four numbers)"},
    {"push", CommandKind::stack, 0, ""},
    {"pop", CommandKind::stack, 0, ""},
    {"end", CommandKind::end, 0, ""},
    {"color", CommandKind::color, 1, ""},
    {"attributes", CommandKind::setting, 1, ""},
    {"background", CommandKind::setting, 1, ""},
    {"light", CommandKind::setting, 1, ""},
    {"ambient", CommandKind::setting, 1, ""},
    {"material", CommandKind::setting, 1, ""},
    {"absorption", CommandKind::of_material, 1, ""},
    {"paint", CommandKind::of_material, 1, ""},
    {"attenuation", CommandKind::setting, 1, ""},
    {"use", CommandKind::use, 1, ""},
}};

/// The row of a word, or null. Unrolled, so that words are compared without function calls.
template <std::size_t... kRows>
const SceneCommand* find_scene_command(std::string_view word, std::index_sequence<kRows...>) {
  const SceneCommand* found = nullptr;
  static_cast<void>(
      ((word == kSceneCommands[kRows].word && (found = &kSceneCommands[kRows]) != nullptr) || ...));
  return found;
}
inline const SceneCommand* find_scene_command(std::string_view word) {
  return find_scene_command(word, std::make_index_sequence<kSceneCommands.size()>());
}

/// True for a setting of color or light, which scenes and headers of stage texts have.
inline bool is_setting(std::string_view word) {
  const SceneCommand* command = find_scene_command(word);
  return command != nullptr && command->is_setting();
}

/// The words of the rows for which `is_wanted(row)`.
template <typename IsWanted>
std::vector<std::string_view> scene_words(IsWanted&& is_wanted) {
  std::vector<std::string_view> words;
  for (const SceneCommand& command : kSceneCommands)
    if (std::invoke(is_wanted, command)) words.push_back(command.word);
  return words;
}

}  // namespace pipeline
