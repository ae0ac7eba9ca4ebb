#pragma once

#include "libpipeline/visibility/span_fill.h"

namespace pipeline {

/// The kernel "avx2" of span_fill.h; null where the processor cannot run it.
const SpanFillKernel* span_fill_avx2();

}  // namespace pipeline
