#include "tools/zbuf/screen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "libpipeline/stream/text_kind.h"

namespace pipeline {

namespace {

constexpr double kLeastStretch = 0.01;  // that is worth a note

/// Whether a file holds a config. Of a pipe, nothing can be read twice.
bool is_config(const std::string& path) {
  std::error_code no_error;
  if (path == "-" || !std::filesystem::is_regular_file(path, no_error)) return false;
  InputFile file(path);
  return kind_of(file.text()) == TextKind::config;
}

/// Why a picture at another size shows other shapes than at the config's; none if it does not.
std::optional<std::string> stretch_note(const Viewport& of_config, const Viewport& screen) {
  const double stretch = static_cast<double>(screen.columns) * of_config.rows /
                         (static_cast<double>(screen.rows) * of_config.columns);
  if (std::abs(std::log(stretch)) <= std::log(1 + kLeastStretch)) return std::nullopt;
  const long rows = std::lround(static_cast<double>(screen.columns) * of_config.rows / of_config.columns);
  std::array<char, 32> times{};
  std::snprintf(times.data(), times.size(), "%.3g", stretch);
  return "a square of the config's " + std::to_string(of_config.columns) + " x " +
         std::to_string(of_config.rows) + " picture is drawn " + times.data() +
         " times as wide as high: --size " + std::to_string(screen.columns) + "x" +
         std::to_string(std::clamp(rows, 1L, static_cast<long>(kMaxViewportSize))) + " keeps its shape";
}

}  // namespace

NamedFile config_of(Tool& tool, const ZbufOptions& chosen) {
  const CommandLine& options = tool.options();
  if (!options.is_given("CONFIG")) return {};
  if (chosen.size.empty() || options.is_given("INPUT") || is_config(chosen.config_path))
    return file_or_stream("CONFIG", chosen.config_path, kStandardInput);
  tool.set_input(chosen.config_path);
  return {};
}

Viewport read_screen(Tool& tool, const ZbufOptions& chosen, const NamedFile& config) {
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

}  // namespace pipeline
