#pragma once

#include <span>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/pixel_grid.h"

namespace pipeline {

// The coverage rules for many triangles at a time. A kernel makes the spans for one kind of processor; all
// make the same ones, to the last bit: those of NearestRows and CenterRows.

/// One implementation. Its functions write the spans of the triangles, one triangle after the other and row
/// by row, within `rows`, and return the end of the last one. There must be room for as many spans as there
/// are rows, for every triangle; the room after the last one may be overwritten.
struct CoverageKernel {
  const char* name;
  TaggedSpan* (*nearest_spans)(const PixelGrid&, std::span<const TaggedTriangle>, const RowRange& rows,
                               TaggedSpan* spans);
  TaggedSpan* (*center_spans)(const ExactGrid&, std::span<const TaggedTriangle>, const RowRange& rows,
                              TaggedSpan* spans);
};

// The functions of the kernel "avx2", which only a processor with AVX2 can run.
TaggedSpan* nearest_spans_avx2(const PixelGrid& grid, std::span<const TaggedTriangle> triangles,
                               const RowRange& rows, TaggedSpan* spans);
TaggedSpan* center_spans_avx2(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                              const RowRange& rows, TaggedSpan* spans);

/// The kernels this processor can run, the fastest last; the first, "portable", runs everywhere.
std::span<const CoverageKernel> coverage_kernels();

/// The kernel in use: the fastest, or the one that the environment variable PIPELINE_KERNEL names
/// (kernel_choice.h).
const CoverageKernel& coverage_kernel();

/// Writes the spans of one triangle likewise; `covered` are its rows by a coverage rule.
template <typename CoveredRows>
TaggedSpan* append_spans(const CoveredRows& covered, PixelTag tag, const RowRange& rows, TaggedSpan* spans) {
  for_each_span(covered, rows, [&](const Span& span) { *spans++ = {span, tag}; });
  return spans;
}

}  // namespace pipeline
