#pragma once

namespace pipeline {

/// The out-of-memory report; writing it allocates nothing.
struct OutOfMemoryReport {
  const char* tool;
  bool is_told_to_next_stage;  // an error line on standard output, where stage text goes

  /// Reports on stderr and, in stage text, to the next stage.
  void report() const noexcept;
};

/// Makes a failed allocation end the process, with a report and exit status 1. That holds from the start of
/// the process until the tool has read its command line: no file is open that could be harmed, and nothing
/// catches an exception yet. Sets the report, and returns it; before this call, the report has the name under
/// which the tool was started, and no error line.
OutOfMemoryReport end_process_without_memory(const OutOfMemoryReport& report) noexcept;
/// Makes a failed allocation throw std::bad_alloc from here on.
void throw_without_memory() noexcept;

}  // namespace pipeline
