#include "libpipeline/text/fixed_text.h"

#include <algorithm>
#include <array>

#include "libpipeline/numbers/kernel_choice.h"
#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/vertex_lines.h"

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
      add({"avx2", kSse4Kernel.read, kSse4Kernel.read_scene, kSse4Kernel.read_columns, kWriteFixedTextAvx2,
           kWriteFixedColumnsAvx2});
#endif
  }
};

}  // namespace

int decimals_of_number(const char* p) {
  const auto digit_count = [](const char* from) {
    return leading_digit_count(load_eight(from) - kEightZeros);
  };
  if (*p == '-') ++p;
  p += digit_count(p);
  if (*p != '.') return 0;
  const std::size_t count = digit_count(p + 1);
  return std::min(static_cast<int>(count == 8 ? count + digit_count(p + 9) : count), kMaxFixedDecimals);
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
