#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "libpipeline/stream/stage_text.h"
#include "libpipeline/text/text_reader.h"
#include "libpipeline/text/text_writer.h"
#include "tools/rim/command_line.h"
#include "tools/rim/out_of_memory.h"
#include "tools/rim/separate_outputs.h"

namespace pipeline {

// The exit statuses of all tools.
constexpr int kExitDone = 0;
constexpr int kExitFailure = 1;  // bad input, or a failure to read or write
constexpr int kExitMisuse = 2;   // a wrong command line

/// A text opened for reading, closed with this object.
class InputFile {
 public:
  /// `path` is a file's name, or "-" for standard input. Throws an IoError if it cannot be opened.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  TextReader& text() { return *text_; }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  std::optional<TextReader> text_;
};

/// The time of a run by phase, for `--timing`. Waiting for the previous stage counts as reading.
struct Timing {
  double read_seconds = 0;
  double work_seconds = 0;
  double write_seconds = 0;
  std::uint64_t triangle_count = 0;
  std::string details;  // counts that only one tool has

  /// Adds the time since the last call (or the start) to `phase`, one of the three above.
  void lap(double Timing::*phase) {
    const auto now = std::chrono::steady_clock::now();
    this->*phase += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// The kind of a tool's output: stage text ends with an error line when the tool fails.
enum class OutputKind { stage_text, other_text };

/// The rim that the tools share: common options, input and output, a single report of a failure, the exit
/// status.
class Tool {
 public:
  Tool(const ToolDescription& description, OutputKind output_kind);

  /// Takes the tool's own options and operands, before it calls `run`.
  CommandLine& options() { return options_; }
  /// Parses the command line, does `work`, and checks that everything is written; returns the exit status.
  int run(int argc, char** argv, const std::function<void()>& work);

  /// The input: the last operand, else standard input. The first call opens it.
  TextReader& input();
  /// The name of the input, or "-" for standard input, for a tool that opens it otherwise.
  [[nodiscard]] const std::string& input_path() const { return input_path_; }
  /// Lets the tool add all its operands, and open their files, itself.
  void take_own_operands() { has_own_operands_ = true; }
  /// Makes another operand than the last one the input.
  void set_input(const std::string& path) { input_path_ = path; }
  /// Opens a text besides the input. A UsageError calls it `name` if both are standard input.
  [[nodiscard]] InputFile second_input(const std::string& path, const std::string& name) const;
  /// Throws a UsageError if two outputs are one file, or one is an input: INPUT or one of `inputs`. Then no
  /// file gets an error line.
  void expect_separate(const std::vector<NamedFile>& outputs, std::vector<NamedFile> inputs = {});
  /// Makes the output a stage text, though the tool usually writes another.
  void write_stage_text() { output_kind_ = OutputKind::stage_text; }
  /// Standard output.
  TextWriter& output() { return output_; }
  /// Flushes and closes the output, for a tool that has more to do once the output is safe; otherwise `run`
  /// does it.
  void close_output();
  Timing& timing() { return timing_; }
  /// True if standard output is not a pipe, so that no later stage can report.
  [[nodiscard]] static bool is_last_stage();
  /// "tool: note: ..." on stderr: a warning; the run continues.
  void note(const std::string& message) const { report(name_ + ": note: " + message); }
  /// Prints a line on stderr as it is: the tool's name is not added.
  static void report(const std::string& line);

 private:
  int status_of(const std::function<void()>& work);
  int fail(const std::string& message, int status);
  int fail_after(const EarlierFailure& failure);
  int fail_misuse(const std::string& message);
  int fail_without_memory() noexcept;
  void tell_next_stage(const std::string& reason);
  void report_timing();

  OutOfMemoryReport out_of_memory_;  // first, as the other members allocate
  std::string name_;
  OutputKind output_kind_;
  CommandLine options_;
  std::string input_help_;
  std::string input_path_ = "-";
  bool has_own_operands_ = false;
  bool wants_timing_ = false;
  std::optional<InputFile> input_;
  TextWriter output_;
  bool output_is_closed_ = false;
  Timing timing_;
};

}  // namespace pipeline
