#include "tools/progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "libpipeline/text/error.h"

namespace pipeline {

Progress::Progress(std::string tool) : tool_(std::move(tool)), is_wanted_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (is_shown_) std::fputc('\n', stderr);
}

void Progress::show(std::uint64_t triangle_count) {
  if (!is_wanted_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_time_) return;
  constexpr std::chrono::milliseconds kBetween(200);
  next_time_ = now + kBetween;
  is_shown_ = true;
  const double rate =
      static_cast<double>(triangle_count) / std::chrono::duration<double>(now - start_).count();
  // The blanks overwrite the end of a longer line.
  std::fprintf(stderr, "\r%s: %s, %.3g million a second    ", tool_.c_str(),
               counted(triangle_count, "triangle").c_str(), rate / 1e6);
  std::fflush(stderr);
}

}  // namespace pipeline
