#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>

#include "libpipeline/raytracing/light_transport.h"

namespace pipeline {

/// How long the parts of a run of `trace` took, and how many rays there were.
struct TraceWork {
  double build_seconds = 0;
  double cast_seconds = 0;
  std::uint64_t primary_rays = 0;
  std::uint64_t exact_decisions = 0;  // exact depth tests
  LightTransport::RayCounts rays;     // the others
};

/// The line of `--timing`.
std::string to_text(const TraceWork& work);

class Stopwatch {
 public:
  /// The seconds since the last call.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace pipeline
