#pragma once

#include "libpipeline/visibility/span_fill.h"

namespace pipeline {

/// The kernel "avx2" of span_fill.h; null where the processor cannot run it or the format has no lanes.
template <typename Depth>
const SpanFillKernel<Depth>* span_fill_avx2();

}  // namespace pipeline
