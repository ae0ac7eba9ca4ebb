#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace pipeline {

/// A line on stderr that tells how far a long run is: triangles, and triangles a second. There is none unless
/// stderr is a terminal, and none in the first second.
class Progress {
 public:
  /// `tool` is what the line begins with.
  explicit Progress(std::string tool);
  /// Ends the line, so that what follows stands on one of its own.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// To be called now and then with the number of triangles so far.
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
