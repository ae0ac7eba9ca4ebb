#include "libpipeline/text/fixed_text.h"

#include <array>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/text/fixed_text_kernels.h"

namespace pipeline {
namespace {

struct KernelList {
  std::array<FixedTextKernel, 3> kernels{};
  std::size_t count = 0;

  void add(const FixedTextKernel& kernel) { kernels[count++] = kernel; }
  KernelList() {
    add(kPortableKernel);
#ifdef PIPELINE_HAS_X86_KERNELS
    if (processor_has_sse4()) add(kSse4Kernel);
    if (processor_has_sse4() && processor_has_avx2())
      add({"avx2", kSse4Kernel.read, kSse4Kernel.read_scene, kWriteFixedTextAvx2});
#endif
  }
};

}  // namespace

std::span<const FixedTextKernel> fixed_text_kernels() {
  static const KernelList list;
  return {list.kernels.data(), list.count};
}

const FixedTextKernel& fixed_text_kernel() {
  static const FixedTextKernel& chosen = chosen_kernel(fixed_text_kernels());
  return chosen;
}

}  // namespace pipeline
