#pragma once

#include <functional>

#include "libpipeline/stream/stage_writer.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/triangle_source.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "tools/tool.h"

namespace pipeline {

/// Transforms a batch in place.
using BatchTransform = std::function<void(TriangleBatch&)>;

/// What a stage does batch by batch until its input ends: read a batch, transform it, write it, and pass it
/// on at once. What was done before a mistake is written before the mistake is thrown. At the end the text is
/// finished, and what the user should know of its digits is said on stderr.
class StageLoop {
 public:
  /// `rounder` is the pattern of those of the transforms. The output does not depend on `thread_count`,
  /// from 1.
  StageLoop(Tool& tool, StageWriter& writer, CoordinateRounder rounder, int thread_count);

  /// Every thread's work is done by a transform of its own, which `make_transform` makes for its rounder.
  void run(TriangleSource& source, const std::function<BatchTransform(CoordinateRounder&)>& make_transform);

 private:
  Tool& tool_;
  StageWriter& writer_;
  CoordinateRounder rounder_;
  int thread_count_;
};

}  // namespace pipeline
