#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "libpipeline/numbers/kernel_choice.h"

namespace pipeline {

/// The numbers of the targets of a kernel that this processor can run.
template <typename Function>
std::vector<std::size_t> testable_targets(const KernelTable<Function>& kernels) {
  std::vector<std::size_t> targets;
  for (std::size_t target = 0; target < kernels.size(); ++target)
    if (kernels[target] != nullptr && can_run(target)) targets.push_back(target);
  return targets;
}

/// Names the tests of a target.
inline std::string name_of_target(const testing::TestParamInfo<std::size_t>& target) {
  return std::string(kTargets[target.param]);
}

}  // namespace pipeline
