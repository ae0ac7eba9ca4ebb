#include "tools/rim/out_of_memory.h"

#include <unistd.h>

#include <cstring>
#include <new>

#include "tools/rim/tool.h"

namespace pipeline {
namespace {

constexpr const char* kMessage = ": not enough memory\n";

/// Initialized at compile time: it is needed before any constructor has run.
constinit OutOfMemoryReport current = {nullptr, false};

/// "BEFORE TOOL: not enough memory" in one write, so that it stays one line among the output of other stages.
void write_line(int descriptor, const char* before, const char* tool) noexcept {
  char line[128] = {};
  std::strncat(line, before, sizeof line / 4);
  std::strncat(line, tool, sizeof line / 4);
  std::strncat(line, kMessage, sizeof line / 4);
  // If this fails as well, only the exit status remains.
  static_cast<void>(!::write(descriptor, line, std::strlen(line)));
}

[[noreturn]] void end_process() {
  current.report();
  ::_exit(kExitFailure);
}

/// Runs before all constructors of the program, some of which allocate.
[[gnu::constructor(101)]] void begin() {
  end_process_without_memory({program_invocation_short_name, false});
}

}  // namespace

void OutOfMemoryReport::report() const noexcept {
  write_line(STDERR_FILENO, "", tool);
  // At a terminal, the line above is enough.
  if (is_told_to_next_stage && ::isatty(STDOUT_FILENO) == 0) write_line(STDOUT_FILENO, "error ", tool);
}

OutOfMemoryReport end_process_without_memory(const OutOfMemoryReport& report) noexcept {
  current = report;
  std::set_new_handler(end_process);
  return report;
}

void throw_without_memory() noexcept {
  std::set_new_handler(nullptr);
}

}  // namespace pipeline
