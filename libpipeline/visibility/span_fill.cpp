#include "libpipeline/visibility/span_fill.h"

#include <array>
#include <cstddef>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/visibility/span_fill_avx2.h"
#include "libpipeline/visibility/span_fill_loop.h"

namespace pipeline {
namespace {

struct KernelList {
  std::array<SpanFillKernel, 2> kernels{};
  std::size_t count = 0;

  KernelList() {
    kernels[count++] = {"portable", fill_span_in_a_loop, fill_span_in_a_loop, fill_span_in_a_loop};
    if (const SpanFillKernel* const avx2 = span_fill_avx2()) kernels[count++] = *avx2;
  }
};

}  // namespace

std::span<const SpanFillKernel> span_fill_kernels() {
  static const KernelList list;
  return {list.kernels.data(), list.count};
}

const SpanFillKernel& span_fill_kernel() {
  static const SpanFillKernel& chosen = chosen_kernel(span_fill_kernels());
  return chosen;
}

}  // namespace pipeline
