#pragma once

#include <cstdint>
#include <string>

#include "libpipeline/raytracing/light_transport.h"

namespace pipeline {

/// How long the parts of a run of `trace` took, and how many rays there were.
struct TraceWork {
  double build_seconds = 0;
  double cast_seconds = 0;
  std::uint64_t primary_rays = 0;
  LightTransport::RayCounts rays;  // the others
};

/// The line of `--timing`.
std::string to_text(const TraceWork& work);

}  // namespace pipeline
