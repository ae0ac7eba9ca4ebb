#pragma once

namespace pipeline {

/// The out-of-memory report; writing it allocates nothing.
struct OutOfMemoryReport {
  const char* tool;
  bool is_told_to_next_stage;  // true if standard output, a stage text, gets an error line

  /// Reports on stderr and, in stage text, to the next stage.
  void report() const noexcept;
};

/// Makes a failed allocation end the process from here on, with `report` and exit status 1. Returns `report`.
/// A process starts like this, with the name under which the tool was started and no error line, until its
/// command line is read: no open file can be harmed yet, and nothing catches exceptions.
OutOfMemoryReport end_process_without_memory(const OutOfMemoryReport& report) noexcept;
/// Makes a failed allocation throw std::bad_alloc from here on.
void throw_without_memory() noexcept;

}  // namespace pipeline
