#include "tools/rim/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <utility>

#include "libpipeline/text/error.h"

namespace pipeline {

Progress::Progress(std::string tool, std::string unit)
    : tool_(std::move(tool)), unit_(std::move(unit)), is_wanted_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (is_shown_) std::fputc('\n', stderr);
}

void Progress::show(std::uint64_t count, double part) {
  if (!is_wanted_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_time_) return;
  constexpr std::chrono::milliseconds kBetween(200);
  next_time_ = now + kBetween;
  is_shown_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double millions = static_cast<double>(count) / seconds / 1e6;
  // The blanks overwrite the end of a longer line before.
  if (part > 0)
    std::fprintf(stderr, "\r%s: %.0f %%, %.0f s left, %.3g million %ss a second    ", tool_.c_str(),
                 std::floor(100 * part), std::ceil(seconds / part - seconds), millions, unit_.c_str());
  else
    std::fprintf(stderr, "\r%s: %s, %.3g million a second    ", tool_.c_str(),
                 counted(count, unit_.c_str()).c_str(), millions);
  std::fflush(stderr);
}

}  // namespace pipeline
