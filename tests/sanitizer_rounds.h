#pragma once

namespace pipeline {

/// The count of random inputs that a test tries: `rounds`, or a fifth with a sanitizer, which slows
/// arithmetic down tenfold and finds its errors in a few rounds.
constexpr int sanitizer_rounds(int rounds) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return rounds / 5;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  return rounds / 5;
#else
  return rounds;
#endif
#else
  return rounds;
#endif
}

}  // namespace pipeline
