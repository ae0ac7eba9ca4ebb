#pragma once

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>

#include "libpipeline/text/error.h"

namespace pipeline {

/// A line on stderr that shows the progress of a long run: the count of triangles or rays, and their rate per
/// second. It appears only on a terminal, and not in the first second.
class Progress {
 public:
  /// The line begins with `tool` and counts in `unit`.
  explicit Progress(std::string tool, std::string unit = "triangle")
      : tool_(std::move(tool)), unit_(std::move(unit)), is_wanted_(::isatty(STDERR_FILENO) == 1) {}
  /// Ends the line.
  ~Progress() {
    if (is_shown_) std::fputc('\n', stderr);
  }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows, at most five times a second, the count so far and the rate; or, with a known `part` of the work
  /// done, from 0 to 1, the percentage, the time left and the rate.
  void show(std::uint64_t count, double part = 0) {
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

 private:
  using Clock = std::chrono::steady_clock;

  std::string tool_;
  std::string unit_;
  bool is_wanted_;
  bool is_shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_time_ = start_ + std::chrono::seconds(1);
};

}  // namespace pipeline
