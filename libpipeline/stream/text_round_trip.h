#pragma once

#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// Rounds calculated triangles as if they had been written in the shortest form (--digits exact) and read
/// back: zeros lose their sign, and x and y whose text is a decimal in exact arithmetic are marked. For a
/// tool that does the work of several stages without the text between them.
void pass_through_text(TriangleBatch& batch);

}  // namespace pipeline
