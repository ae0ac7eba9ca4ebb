#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "libpipeline/raytracing/light_transport.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/visibility/fragment.h"

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

/// The rays that make the color of a pixel, a line each without a line feed: docs/ray-tracing.md has the
/// format.
std::vector<std::string> ray_lines(const Pixel& pixel, const RayCaster& caster,
                                   const LightTransport& transport, const PixelRays& rays);

}  // namespace pipeline
