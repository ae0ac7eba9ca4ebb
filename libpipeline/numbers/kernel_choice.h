#pragma once

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <string_view>

namespace pipeline {

/// Chooses the kernel to use from a list that runs from "portable" to the fastest: the last, or the fastest
/// one up to the level that the environment variable PIPELINE_KERNEL names (for tests). An unknown name has
/// no effect.
template <typename Kernel>
const Kernel& chosen_kernel(std::span<const Kernel> kernels) {
  constexpr std::array<std::string_view, 3> kNames = {"portable", "sse4", "avx2"};
  const char* const variable = std::getenv("PIPELINE_KERNEL");
  const auto limit = std::find(kNames.begin(), kNames.end(), variable == nullptr ? "" : variable);
  std::size_t chosen = kernels.size() - 1;
  while (chosen > 0 && std::find(kNames.begin(), kNames.end(), kernels[chosen].name) > limit) --chosen;
  return kernels[chosen];
}

}  // namespace pipeline
