#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace pipeline {

/// A line on stderr that shows the progress of a long run: triangles, and triangles a second. It appears only
/// on a terminal, and not in the first second.
class Progress {
 public:
  /// The line begins with `tool`.
  explicit Progress(std::string tool);
  /// Ends the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the number of triangles so far, at most five times a second.
  void show(std::uint64_t triangle_count);

 private:
  using Clock = std::chrono::steady_clock;

  std::string tool_;
  bool is_wanted_;
  bool is_shown_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_time_ = start_ + std::chrono::seconds(1);
};

}  // namespace pipeline
