#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// A batch of triangles to be drawn, and a tag for each.
struct TaggedBatch {
  TriangleBatch batch;
  std::vector<PixelTag> tags;
};

/// Triangle `index` of a batch in NDC; refers to the batch.
inline ExactTriangle exact_triangle(const TriangleBatch& batch, std::size_t index) {
  return {batch.triangles[index], batch.low_parts.empty() ? nullptr : &batch.low_parts[index],
          batch.decimal_marks.empty() ? std::uint16_t{0} : batch.decimal_marks[index]};
}

}  // namespace pipeline
