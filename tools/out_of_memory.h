#pragma once

namespace pipeline {

/// What is to be told when there is no memory left, not even to make a message of.
struct OutOfMemoryReport {
  const char* tool;
  bool is_told_to_next_stage;  // an error line on standard output, where stage text goes

  /// Says so on stderr and, in stage text, to the next stage. Needs no memory.
  void report() const noexcept;
};

/// From the start of the process until a tool has read its command line nothing is open that could be harmed,
/// and nothing catches an exception yet: an allocation that fails then ends the process, with a report and
/// exit status 1. Here the tool says who it is, and gets that back; until then it is the name it was called
/// by, and there is no error line.
OutOfMemoryReport end_process_without_memory(const OutOfMemoryReport& report) noexcept;
/// From here on an allocation that fails is a std::bad_alloc.
void throw_without_memory() noexcept;

}  // namespace pipeline
