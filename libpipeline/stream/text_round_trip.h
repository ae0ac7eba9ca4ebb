#pragma once

#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// Makes calculated triangles those that a reader gets from their text in the shortest form (--digits exact):
/// zeros have no sign, and the coordinates whose text is a decimal in exact arithmetic are marked, x and y
/// alone. For a stage that takes in one what others pass through a pipe.
void pass_through_text(TriangleBatch& batch);

}  // namespace pipeline
