#pragma once

#include <string>
#include <vector>

#include "libpipeline/raytracing/light_transport.h"
#include "libpipeline/raytracing/ray_caster.h"
#include "libpipeline/visibility/fragment.h"

namespace pipeline {

/// The rays that make the color of a pixel, a line each without a line feed: docs/ray-tracing.md has the
/// format.
std::vector<std::string> ray_lines(const Pixel& pixel, const RayCaster& caster,
                                   const LightTransport& transport, const PixelRays& rays);

}  // namespace pipeline
