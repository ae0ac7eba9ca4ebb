#include "libpipeline/coverage/avx2.h"

namespace pipeline {

#if defined(__x86_64__) && defined(__GNUC__)

const CoverageKernel* coverage_avx2() {
  static constexpr CoverageKernel kKernel = {"avx2", nearest_spans_avx2, center_spans_avx2};
  return __builtin_cpu_supports("avx2") ? &kKernel : nullptr;
}

#else

const CoverageKernel* coverage_avx2() {
  return nullptr;
}

#endif

}  // namespace pipeline
