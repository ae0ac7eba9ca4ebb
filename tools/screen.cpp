#include "tools/screen.h"

#include <stdexcept>
#include <string>

#include "libpipeline/stream/text_kind.h"

namespace pipeline {

Viewport read_screen(Tool& tool, const ZbufOptions& chosen) {
  const bool has_operand = tool.options().is_given("CONFIG");
  if (const auto screen = parse_size(chosen.size)) {
    if (tool.options().is_given("INPUT"))
      throw UsageError(expected_but_found("INPUT as the only operand with --size",
                                          pipeline::quoted(chosen.config_path) + " before it"));
    if (has_operand) tool.set_input(chosen.config_path);
    return *screen;
  }
  if (!has_operand) throw UsageError(expected_but_found("an operand CONFIG, or --size", "none"));
  try {
    InputFile file = tool.second_input(chosen.config_path, "CONFIG");
    expect_kind(file.text(), TextKind::config);
    return read_config(file.text());
  } catch (const IoError& error) {
    if (!parse_size(chosen.config_path)) throw;
    throw std::runtime_error(std::string(error.what()) + " (did you mean --size " + chosen.config_path +
                             "?)");
  }
}

}  // namespace pipeline
