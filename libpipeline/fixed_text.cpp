#include "libpipeline/fixed_text.h"

#include <array>
#include <cstdlib>
#include <string_view>

#include "libpipeline/fixed_text_kernels.h"

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
    if (processor_has_sse4() && processor_has_avx2()) add({"avx2", kSse4Kernel.read, kWriteFixedTextAvx2});
#endif
  }
};

}  // namespace

std::span<const FixedTextKernel> fixed_text_kernels() {
  static const KernelList list;
  return {list.kernels.data(), list.count};
}

const FixedTextKernel& fixed_text_kernel() {
  static const FixedTextKernel& chosen = []() -> const FixedTextKernel& {
    const char* const name = std::getenv("PIPELINE_KERNEL");
    for (const FixedTextKernel& kernel : fixed_text_kernels())
      if (name != nullptr && std::string_view(name) == kernel.name) return kernel;
    return fixed_text_kernels().back();
  }();
  return chosen;
}

}  // namespace pipeline
