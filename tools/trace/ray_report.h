#pragma once

#include <string>
#include <vector>

#include "libpipeline/visibility/fragment_log.h"
#include "tools/trace/traced_scene.h"

namespace pipeline {

/// Adds a line, without a line feed, for each ray that makes the color of a pixel; docs/ray-tracing.md has
/// the format.
void add_ray_lines(const Pixel& pixel, const TracedScene& scene, const Bvh& bvh,
                   std::vector<std::string>& lines);

}  // namespace pipeline
