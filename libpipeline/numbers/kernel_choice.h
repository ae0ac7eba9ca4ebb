#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace pipeline {

/// The kinds of processors that kernels are compiled for. Each can also run the kernels of earlier kinds of
/// its family. `simd128` is WebAssembly's.
inline constexpr std::array<std::string_view, 6> kTargets = {"scalar", "neon", "simd128",
                                                             "sse4",   "avx2", "avx512"};

/// A function compiled for each of kTargets; null for targets of other families.
template <typename Function>
using KernelTable = std::array<Function, kTargets.size()>;

/// The table of a function of HWY_NAMESPACE (vector_targets.h).
#define PIPELINE_KERNEL_TABLE(function)                                                  \
  {                                                                                      \
    HWY_CHOOSE_FALLBACK(function), HWY_CHOOSE_NEON(function), HWY_CHOOSE_WASM(function), \
        HWY_CHOOSE_SSE4(function), HWY_CHOOSE_AVX2(function), HWY_CHOOSE_AVX3(function)  \
  }

/// False if this processor cannot run a target of its family; targets of other families are not tested.
inline bool can_run(std::size_t target) {
#if defined(__x86_64__) && defined(__GNUC__)
  if (target > 2 && !__builtin_cpu_supports("sse4.2")) return false;
  if (target > 3 && !(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                      __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2")))
    return false;
  if (target > 4 && !(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")))
    return false;
#endif
  return target < kTargets.size();
}

/// The last target for which can_run() is true, perhaps of another family, and at most the one named by the
/// environment variable PIPELINE_KERNEL (for tests). An unknown name has no effect.
inline std::size_t best_target() {
  static const std::size_t best = [] {
    const char* const variable = std::getenv("PIPELINE_KERNEL");
    const auto limit = std::find(kTargets.begin(), kTargets.end(), variable == nullptr ? "" : variable);
    std::size_t target = std::min<std::size_t>(limit - kTargets.begin(), kTargets.size() - 1);
    while (!can_run(target)) --target;
    return target;
  }();
  return best;
}

/// The kernel to use: the best target's, or that of the last target before it that has one.
template <typename Function>
Function chosen_kernel(const KernelTable<Function>& kernels) {
  std::size_t target = best_target();
  while (target > 0 && kernels[target] == nullptr) --target;
  return kernels[target];
}

}  // namespace pipeline
