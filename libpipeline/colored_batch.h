#pragma once

#include <vector>

#include "libpipeline/color.h"
#include "libpipeline/triangle_batch.h"

namespace pipeline {

/// A batch of triangles to be drawn, and a colour for each.
struct ColoredBatch {
  TriangleBatch batch;
  std::vector<Color> colors;
};

}  // namespace pipeline
