#include "tools/rim/tool.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <stdexcept>

#include "libpipeline/text/error.h"
#include "libpipeline/text/output_file.h"
#include "tools/version.h"

namespace pipeline {
namespace {

int open_for_reading(const std::string& path) {
  if (path == "-") return STDIN_FILENO;
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw IoError("open", path.empty() ? "''" : path, errno);
  return descriptor;
}

/// Reopens closed standard descriptors on /dev/null in the wrong direction: their use is still an error, and
/// no file of ours gets their numbers.
void open_closed_descriptors() {
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0)
      ::open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// True for a pipe, or a socket: some shells make pipes of sockets.
bool is_pipe(int descriptor) {
  struct stat status = {};
  return ::fstat(descriptor, &status) == 0 && (S_ISFIFO(status.st_mode) || S_ISSOCK(status.st_mode));
}

std::string end_line;  // for the handler

/// Removes unfinished files, then ends the process by the signal, as without this handler.
void end_cleanly(int number) {
  if (remove_unfinished()) static_cast<void>(::write(STDERR_FILENO, end_line.data(), end_line.size()) < 0);
  std::signal(number, SIG_DFL);
  ::raise(number);  // delivered once this handler has returned
}

void end_cleanly_at_signals(const std::string& tool) {
  end_line = tool + ": ended by a signal; unfinished files are removed\n";
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    if (std::signal(number, end_cleanly) == SIG_IGN) std::signal(number, SIG_IGN);  // by nohup
}

/// Enlarges the pipe of a file descriptor to 1 MiB, if the system allows it, so that the stages of a pipe
/// seldom wait for each other. A larger pipe and any other file stay as they are.
void enlarge_pipe([[maybe_unused]] int descriptor) {
#ifdef F_SETPIPE_SZ
  constexpr int kPipeSize = 1 << 20;
  // For a file that is not a pipe, the size is -1; if the system refuses, the pipe keeps its size.
  const int size = ::fcntl(descriptor, F_GETPIPE_SZ);
  if (size >= 0 && size < kPipeSize) ::fcntl(descriptor, F_SETPIPE_SZ, kPipeSize);
#endif
}

}  // namespace

InputFile::InputFile(const std::string& path)
    : descriptor_(open_for_reading(path)),
      text_(std::in_place, descriptor_, path == "-" ? "<stdin>" : path) {}

InputFile::~InputFile() {
  if (descriptor_ != STDIN_FILENO) ::close(descriptor_);
}

Tool::Tool(const ToolDescription& description, OutputKind output_kind)
    : out_of_memory_(end_process_without_memory({description.name, output_kind == OutputKind::stage_text})),
      name_(description.name),
      output_kind_(output_kind),
      options_(description, name_ + " (pipeline) " + kVersion),
      input_help_(std::string(description.input) + "; - is standard input"),
      output_(STDOUT_FILENO, "<stdout>") {
  open_closed_descriptors();
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond a file's size limit fails like any other
  options_.add_flag("--timing", wants_timing_, "Report on stderr the time for reading, working and writing");
}

TextReader& Tool::input() {
  if (!input_) {
    input_.emplace(input_path_);
    if (input_path_ == "-") enlarge_pipe(STDIN_FILENO);
  }
  return input_->text();
}

InputFile Tool::second_input(const std::string& path, const std::string& name) const {
  if (path == "-" && input_path_ == "-") throw UsageError(name, "a file, as INPUT is standard input", "'-'");
  return InputFile(path);
}

void Tool::expect_separate(const std::vector<NamedFile>& outputs, std::vector<NamedFile> inputs) {
  if (!has_own_operands_) {
    inputs.push_back(file_or_stream("INPUT", input_path_, kStandardInput));
    inputs.back().is_in_place = true;
  }
  try {
    pipeline::expect_separate(outputs, inputs);
  } catch (const UsageError&) {
    if (is_last_stage()) output_kind_ = OutputKind::other_text;
    throw;
  }
}

int Tool::run(int argc, char** argv, const std::function<void()>& work) {
  if (!has_own_operands_) options_.add_operand("INPUT", input_path_, input_help_);
  try {
    if (const auto asked_for = options_.parse(argc, argv)) {  // --help or --version
      output_kind_ = OutputKind::other_text;
      return status_of([&] {
        output_.append(*asked_for);
        close_output();
      });
    }
  } catch (const UsageError& error) {
    return fail_misuse(error.what());
  }
  const int status = status_of([&] {
    end_cleanly_at_signals(name_);
    enlarge_pipe(STDOUT_FILENO);
    work();
    close_output();
    if (wants_timing_) report_timing();
  });
  if (status != kExitDone) remove_unfinished();
  return status;
}

/// Memory may also run out while another failure is reported.
int Tool::status_of(const std::function<void()>& work) try {
  throw_without_memory();
  try {
    work();
    return kExitDone;
  } catch (const UsageError& error) {
    return fail_misuse(error.what());
  } catch (const EarlierFailure& error) {
    return fail_after(error);
  } catch (const InputError& error) {
    return error.location().is_option() ? fail_misuse(error.what()) : fail(error.what(), kExitFailure);
  } catch (const IoError& error) {
    if (error.error_number() == EPIPE) return kExitFailure;  // the reader has closed the pipe
    return fail(error.what(), kExitFailure);
  } catch (const std::bad_alloc&) {
    return fail_without_memory();
  } catch (const std::length_error&) {  // too much for an address space of 32 bits
    return fail_without_memory();
  } catch (const std::exception& error) {
    return fail(error.what(), kExitFailure);
  }
} catch (const std::bad_alloc&) {
  return fail_without_memory();
}

void Tool::close_output() {
  if (output_is_closed_) return;
  output_.flush();
  output_is_closed_ = true;
  // Some file systems report a full disk only here.
  if (::close(STDOUT_FILENO) != 0) throw IoError("write", "<stdout>", errno);
  timing_.lap(&Timing::write_seconds);
}

bool Tool::is_last_stage() {
  return !is_pipe(STDOUT_FILENO);
}

void Tool::report(const std::string& line) {
  std::fprintf(stderr, "%s\n", on_one_line(line).c_str());
}

int Tool::fail_misuse(const std::string& message) {
  return fail(message + " (try " + name_ + " --help)", kExitMisuse);
}

/// Reports the message on stderr and to the next stage.
int Tool::fail(const std::string& message, int status) {
  report(name_ + ": " + message);
  tell_next_stage(name_ + ": " + message);
  return status;
}

/// Passes on the failure of an earlier stage. In a pipe, that stage has reported it on the same stderr, so
/// only the last stage adds that there is no output.
int Tool::fail_after(const EarlierFailure& failure) {
  const bool makes_picture = output_kind_ == OutputKind::other_text;
  if (!input_ || !is_pipe(input_->descriptor()))
    report(name_ + ": " + failure.what());
  else if (makes_picture || is_last_stage())
    report(name_ + (makes_picture ? ": no picture: " : ": no output: ") + failure.in_short());
  tell_next_stage(failure.reason());
  return kExitFailure;
}

/// Ends a stage text with an error line.
void Tool::tell_next_stage(const std::string& reason) {
  if (output_kind_ == OutputKind::other_text) return;
  try {
    // At a terminal, the message on stderr is enough.
    if (::isatty(STDOUT_FILENO) == 0) output_.append(error_line(reason));
    output_.flush();
  } catch (const IoError&) {
    // The output has failed, too, or was the failure; only the exit status is left.
  }
}

int Tool::fail_without_memory() noexcept {
  out_of_memory_.is_told_to_next_stage = output_kind_ == OutputKind::stage_text;
  try {
    if (out_of_memory_.is_told_to_next_stage) output_.flush();
  } catch (const std::exception&) {
    // The output has failed, too; only the exit status is left.
  }
  out_of_memory_.report();
  return kExitFailure;
}

void Tool::report_timing() {
  char line[256];
  const double seconds = timing_.read_seconds + timing_.work_seconds + timing_.write_seconds;
  const double read_mb = input_ ? static_cast<double>(input_->text().bytes_read()) / 1e6 : 0;
  const double written_mb = static_cast<double>(output_.bytes_written()) / 1e6;
  std::snprintf(line, sizeof line,
                "%s: %s in %.3f s (read %.3f, work %.3f, write %.3f), %.1f MB in, %.1f MB out, %.0f MB/s",
                name_.c_str(), counted(timing_.triangle_count, "triangle").c_str(), seconds,
                timing_.read_seconds, timing_.work_seconds, timing_.write_seconds, read_mb, written_mb,
                seconds > 0 ? read_mb / seconds : 0.0);
  report(line + (timing_.details.empty() ? "" : "; " + timing_.details));
}

}  // namespace pipeline
