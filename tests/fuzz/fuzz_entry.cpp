// The entry of every target.

#include "tests/fuzz/fuzz_bytes.h"

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer's name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pipeline::check(pipeline::FuzzBytes(data, size));
  return 0;
}
