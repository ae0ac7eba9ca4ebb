#pragma once

#include <string>
#include <vector>

namespace pipeline {

/// An output of a run.
struct NamedOutput {
  std::string option;  // that gives its path; empty for standard output
  std::string path;    // empty if there is no such output
};

NamedOutput standard_output();

/// A UsageError if two of a run's outputs end up in one regular file or one pipe, where one would replace the
/// other or both would mix. Devices may be shared.
void expect_separate(const std::vector<NamedOutput>& outputs);

}  // namespace pipeline
