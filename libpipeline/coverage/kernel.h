#pragma once

#include <span>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/scene/pixel_grid.h"

namespace pipeline {

// The coverage rules for many triangles at a time. A kernel makes the spans for one kind of processor; all
// make the spans of NearestRows and CenterRows, to the last bit.

/// Writes the spans of the triangles, one triangle after the other and row by row, within `rows`, and returns
/// the end of the last one. There must be room for as many spans as there are rows, for every triangle; the
/// room after the last one may be overwritten.
using NearestSpans = TaggedSpan* (*)(const PixelGrid& grid, std::span<const TaggedTriangle> triangles,
                                     const RowRange& rows, TaggedSpan* spans);
using CenterSpans = TaggedSpan* (*)(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                                    const RowRange& rows, TaggedSpan* spans);

const KernelTable<NearestSpans>& nearest_kernels();
const KernelTable<CenterSpans>& center_kernels();

/// Writes the spans of one triangle likewise; `covered` are its rows by a coverage rule.
template <typename CoveredRows>
TaggedSpan* append_spans(const CoveredRows& covered, PixelTag tag, const RowRange& rows, TaggedSpan* spans) {
  for_each_span(covered, rows, [&](const Span& span) { *spans++ = {span, tag}; });
  return spans;
}

}  // namespace pipeline
