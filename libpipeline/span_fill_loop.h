#pragma once

#include "libpipeline/span_fill.h"

namespace pipeline {

/// The kernel that runs everywhere: pixel by pixel.
template <typename Depth>
void fill_span_in_a_loop(const SpanFill<Depth>& pixels) {
  const SpanDepth depth = pixels.span.depth;
  const int first_column = pixels.span.first_column;
  const int count = pixels.span.last_column - first_column + 1;
  for (int i = 0; i < count; ++i) {
    const double z = depth(first_column + i);
    const typename Depth::Stored stored = pixels.format.store(z);
    if (!(stored < pixels.depths[i] && z >= pixels.front)) continue;
    pixels.depths[i] = stored;
    pixels.colors[i] = pixels.color;
  }
}

}  // namespace pipeline
