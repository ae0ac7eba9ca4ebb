#include "libpipeline/stream/memory.h"

#include <gtest/gtest.h>

#include <new>

namespace pipeline {
namespace {

TEST(AvailableMemory, IsWhatIsAvailableAndFreeSwapSpace) {
  EXPECT_EQ(available_memory(
                "MemTotal:       24684112 kB\nMemFree:        22025684 kB\nMemAvailable:   23772776 kB\n"
                "SwapCached:            7 kB\nSwapTotal:       1048576 kB\nSwapFree:         524288 kB\n"
                "Dirty:                 1 kB\n"),
            std::size_t{23772776 + 524288} * 1024);
}

TEST(AvailableMemory, IsUnknownWithoutBothLines) {
  EXPECT_EQ(available_memory(""), std::nullopt);
  EXPECT_EQ(available_memory("MemTotal: 1 kB\nMemAvailable: 1 kB\n"), std::nullopt);
  EXPECT_EQ(available_memory("MemTotal: 1 kB\nSwapFree: 1 kB\n"), std::nullopt);
  EXPECT_EQ(available_memory("MemTotal: 1 kB\nMemAvailable: much\nSwapFree: 1 kB\n"), std::nullopt);
}

TEST(AvailableMemory, OfMoreThanAnyMachineHasIsAnError) {
  expect_available_memory(0);
#ifdef __linux__
  EXPECT_THROW(expect_available_memory(SIZE_MAX), std::bad_alloc);
#endif
}

}  // namespace
}  // namespace pipeline
