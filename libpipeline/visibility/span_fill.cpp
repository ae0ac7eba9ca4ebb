#include "libpipeline/visibility/span_fill.h"

#include <array>
#include <cstddef>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/visibility/span_fill_avx2.h"
#include "libpipeline/visibility/span_fill_loop.h"

namespace pipeline {
namespace {

template <typename Depth>
struct KernelList {
  std::array<SpanFillKernel<Depth>, 2> kernels{};
  std::size_t count = 0;

  KernelList() {
    kernels[count++] = {"portable", fill_span_in_a_loop};
    if (const auto* const avx2 = span_fill_avx2<Depth>()) kernels[count++] = *avx2;
  }
};

}  // namespace

template <typename Depth>
std::span<const SpanFillKernel<Depth>> span_fill_kernels() {
  static const KernelList<Depth> list;
  return {list.kernels.data(), list.count};
}

template <typename Depth>
const SpanFillKernel<Depth>& span_fill_kernel() {
  static const SpanFillKernel<Depth>& chosen = chosen_kernel(span_fill_kernels<Depth>());
  return chosen;
}

#define PIPELINE_INSTANTIATE(Depth)                                           \
  template std::span<const SpanFillKernel<Depth>> span_fill_kernels<Depth>(); \
  template const SpanFillKernel<Depth>& span_fill_kernel<Depth>();
PIPELINE_FOR_EACH_DEPTH_FORMAT(PIPELINE_INSTANTIATE)
#undef PIPELINE_INSTANTIATE

}  // namespace pipeline
