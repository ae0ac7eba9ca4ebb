#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace pipeline {

/// A line on stderr that shows the progress of a long run: the count of triangles or rays, and their rate per
/// second. It appears only on a terminal, and not in the first second.
class Progress {
 public:
  /// The line begins with `tool` and counts in `unit`.
  explicit Progress(std::string tool, std::string unit = "triangle");
  /// Ends the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows, at most five times a second, the count so far and the rate; or, with a known `part` of the work
  /// done, from 0 to 1, the percentage, the time left and the rate.
  void show(std::uint64_t count, double part = 0);

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
