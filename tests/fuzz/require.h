#pragma once

#include <cstdio>
#include <cstdlib>

namespace pipeline {

/// Ends the process with a message unless the claim holds; to a fuzzer, this is a crash.
inline void require(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", claim);
  std::abort();
}

}  // namespace pipeline
