#include "libpipeline/coverage/kernel.h"

#include <array>
#include <cstddef>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/nearest.h"
#include "libpipeline/numbers/kernel_choice.h"

namespace pipeline {
namespace {

TaggedSpan* nearest_spans(const PixelGrid& grid, std::span<const TaggedTriangle> triangles,
                          const RowRange& rows, TaggedSpan* spans) {
  for (const auto& [triangle, tag] : triangles)
    spans = append_spans(NearestRows(grid, triangle.p_ndc), tag, rows, spans);
  return spans;
}

TaggedSpan* center_spans(const ExactGrid& grid, std::span<const TaggedTriangle> triangles,
                         const RowRange& rows, TaggedSpan* spans) {
  for (const auto& [triangle, tag] : triangles)
    spans = append_spans(CenterRows(grid, triangle), tag, rows, spans);
  return spans;
}

struct KernelList {
  std::array<CoverageKernel, 2> kernels{};
  std::size_t count = 0;

  KernelList() {
    kernels[count++] = {"portable", nearest_spans, center_spans};
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("avx2")) kernels[count++] = {"avx2", nearest_spans_avx2, center_spans_avx2};
#endif
  }
};

}  // namespace

std::span<const CoverageKernel> coverage_kernels() {
  static const KernelList list;
  return {list.kernels.data(), list.count};
}

const CoverageKernel& coverage_kernel() {
  static const CoverageKernel& chosen = chosen_kernel(coverage_kernels());
  return chosen;
}

}  // namespace pipeline
