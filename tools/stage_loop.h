#pragma once

#include <functional>

#include "libpipeline/coordinate_rounder.h"
#include "libpipeline/stage_reader.h"
#include "libpipeline/stage_writer.h"
#include "libpipeline/triangle_batch.h"
#include "tools/tool.h"

namespace pipeline {

/// What a stage does batch by batch until its input ends: `read` a batch (false at the end), `transform` it
/// in place, write it, and pass it on at once. What was done before a mistake is written before the mistake
/// is thrown. At the end the text is finished, and what the user should know of its digits is said on stderr.
struct StageLoop {
  Tool& tool;
  StageWriter& writer;
  CoordinateRounder& rounder;

  void run(const std::function<bool(TriangleBatch&)>& read,
           const std::function<void(TriangleBatch&)>& transform);
};

}  // namespace pipeline
