#pragma once

#include "libpipeline/coverage/kernel.h"

namespace pipeline {

/// The kernel "avx2" of kernel.h; null where the processor cannot run it.
const CoverageKernel* coverage_avx2();

// Its functions, which only such a processor runs. They work on four triangles at a time, and then on a
// row of each or, where one is high or out of the ordinary, on four rows of one after the other.

TaggedSpan* nearest_spans_avx2(const PixelGrid& grid, std::span<const TaggedTriangle> triangles,
                               const RowRange& rows, TaggedSpan* spans);
TaggedSpan* center_spans_avx2(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                              const RowRange& rows, TaggedSpan* spans);

}  // namespace pipeline
