#include "libpipeline/text/fixed_text.h"

#include <algorithm>
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
      add({"avx2", kSse4Kernel.read, kSse4Kernel.read_scene, kWriteFixedTextAvx2, kSse4Kernel.read_three,
           kWriteThreeFixedAvx2});
#endif
  }
};

}  // namespace

int decimals_of_stage_text(std::string_view text) {
  constexpr std::size_t kMaxLength = 1 + 15 + 1;  // a sign, digits and a point
  int decimals = 0;
  bool is_behind_point = false;
  for (const char c : text.substr(0, kMaxLength)) {
    if (c == ' ' || c == '\n') break;
    if (is_behind_point) ++decimals;
    if (c == '.') is_behind_point = true;
  }
  return std::min(decimals, kMaxFixedDecimals);
}

int decimals_of_scene(std::string_view text) {
  return decimals_of_stage_text(text.substr(std::min(text.find('\n'), text.size() - 1) + 1));
}

std::span<const FixedTextKernel> fixed_text_kernels() {
  static const KernelList list;
  return {list.kernels.data(), list.count};
}

const FixedTextKernel& fixed_text_kernel() {
  static const FixedTextKernel& chosen = chosen_kernel(fixed_text_kernels());
  return chosen;
}

}  // namespace pipeline
