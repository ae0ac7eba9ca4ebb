#include "tools/zbuf/screen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <variant>

#include "libpipeline/scene/config.h"
#include "libpipeline/stream/text_kind.h"

namespace pipeline {

namespace {

/// True if a regular file holds a config; a pipe cannot be read twice.
bool is_config(const std::string& path) {
  std::error_code no_error;
  if (path == "-" || !std::filesystem::is_regular_file(path, no_error)) return false;
  InputFile file(path);
  return kind_of(file.text()) == TextKind::config;
}

std::string times_as_wide(double stretch) {
  std::array<char, 32> times{};
  std::snprintf(times.data(), times.size(), "%.3g", stretch);
  return std::string(times.data()) + " times as wide as high: ";
}

bool is_size(double pixels) {
  return pixels >= 0.5 && pixels <= kMaxViewportSize;
}

std::string size_option(double columns, double rows) {
  const auto count = [](double pixels) {
    return std::to_string(std::lround(std::clamp(pixels, 1.0, static_cast<double>(kMaxViewportSize))));
  };
  return "--size " + count(columns) + "x" + count(rows);
}

/// The note on a picture that shows other shapes than at the config's size; none if it does not.
std::optional<std::string> stretch_note(const Viewport& of_config, const Viewport& screen) {
  constexpr double kLeastStretch = 0.01;  // that deserves a note
  const double stretch = static_cast<double>(screen.columns) * of_config.rows /
                         (static_cast<double>(screen.rows) * of_config.columns);
  if (std::abs(std::log(stretch)) <= std::log(1 + kLeastStretch)) return std::nullopt;
  const double rows = static_cast<double>(screen.columns) * of_config.rows / of_config.columns;
  const std::string option =
      is_size(rows) ? size_option(screen.columns, rows) : size_option(of_config.columns, of_config.rows);
  return "a square of the config's " + std::to_string(of_config.columns) + " x " +
         std::to_string(of_config.rows) + " picture is drawn " + times_as_wide(stretch) + option +
         " keeps its shape";
}

/// Width / height of a projection's window from -1 to 1; none for a perspective by the rule angle.
std::optional<double> shape_of(const Projection& projection) {
  if (const auto* perspective = std::get_if<Perspective>(&projection)) {
    if (perspective->aspect_rule == AspectRule::angle) return std::nullopt;
    return perspective->aspect;
  }
  const auto shape = [](const auto& p) { return std::abs((p.right - p.left) / (p.top - p.bottom)); };
  if (const auto* frustum = std::get_if<Frustum>(&projection)) return shape(*frustum);
  return shape(std::get<Orthographic>(projection));
}

}  // namespace

NamedFile config_of(Tool& tool, const PictureOptions& chosen) {
  const CommandLine& options = tool.options();
  if (!options.is_given("CONFIG")) return {};
  if (chosen.size.empty() || options.is_given("INPUT") || is_config(chosen.config_path))
    return file_or_stream("CONFIG", chosen.config_path, kStandardInput);
  tool.set_input(chosen.config_path);
  return {};
}

Viewport read_screen(Tool& tool, const PictureOptions& chosen, const NamedFile& config) {
  const std::optional<Viewport> size = parse_size(chosen.size);
  const bool has_config = !config.name.empty();
  if (size && !has_config) return *size;
  if (!has_config) throw UsageError(expected_but_found("an operand CONFIG, or --size", "none"));
  try {
    InputFile file = tool.second_input(chosen.config_path, "CONFIG");
    expect_kind(file.text(), TextKind::config);
    Viewport screen = read_config(file.text());
    if (!size) return screen;
    if (const auto note = stretch_note(screen, *size)) tool.note(*note);
    screen.columns = size->columns;
    screen.rows = size->rows;
    return screen;
  } catch (const IoError& error) {
    if (!parse_size(chosen.config_path)) throw;
    throw std::runtime_error(std::string(error.what()) + " (did you mean --size " + chosen.config_path +
                             "?)");
  }
}

std::optional<std::string> squeezed_note(const Projection& projection, const Viewport& screen) {
  const std::optional<double> of_camera = shape_of(projection);
  if (!of_camera) return std::nullopt;
  const double shape = *of_camera * (screen.left / screen.bottom);
  // The size may differ by half a pixel in either direction.
  if (std::abs(screen.columns - shape * screen.rows) <= (1 + shape) / 2) return std::nullopt;
  const double columns = shape * screen.rows;
  const double rows = screen.columns / shape;
  const double most = kMaxViewportSize * std::min(shape, 1.0);  // columns of a screen of this shape
  const std::string option = is_size(columns) ? size_option(columns, screen.rows)
                             : is_size(rows)  ? size_option(screen.columns, rows)
                                              : size_option(most, most / shape);
  return "a square is drawn " + times_as_wide(screen.columns / columns) + option +
         " has the shape of the camera's window";
}

std::optional<std::string> squeezed_note_of_projected(const Projection& projected, const Viewport& screen) {
  const auto* frustum = std::get_if<Frustum>(&projected);
  if (frustum != nullptr && frustum->left == -frustum->right && frustum->bottom == -frustum->top)
    return std::nullopt;
  return squeezed_note(projected, screen);
}

}  // namespace pipeline
