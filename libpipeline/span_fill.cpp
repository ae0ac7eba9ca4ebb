#include "libpipeline/span_fill.h"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string_view>

#include "libpipeline/span_fill_avx2.h"

namespace pipeline {
namespace {

template <typename Depth>
void fill_span(const SpanFill<Depth>& pixels) {
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

struct KernelList {
  std::array<SpanFillKernel, 2> kernels{};
  std::size_t count = 0;

  KernelList() {
    kernels[count++] = {"portable", fill_span, fill_span, fill_span};
    if (const SpanFillKernel* const avx2 = span_fill_avx2()) kernels[count++] = *avx2;
  }
};

const SpanFillKernel& chosen_kernel() {
  const auto kernels = span_fill_kernels();
  const char* const variable = std::getenv("PIPELINE_KERNEL");
  const std::string_view name = variable == nullptr ? "" : variable;
  if (name == "sse4") return kernels.front();
  for (const SpanFillKernel& kernel : kernels)
    if (name == kernel.name) return kernel;
  return kernels.back();
}

}  // namespace

std::span<const SpanFillKernel> span_fill_kernels() {
  static const KernelList list;
  return {list.kernels.data(), list.count};
}

const SpanFillKernel& span_fill_kernel() {
  static const SpanFillKernel& chosen = chosen_kernel();
  return chosen;
}

}  // namespace pipeline
