#include "libpipeline/stream/large_pages.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace pipeline {

void prefer_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t size) {
#ifdef MADV_HUGEPAGE
  // The tail stays on small pages, so nothing is over-allocated.
  madvise(begin, size, MADV_HUGEPAGE);
#endif
}

}  // namespace pipeline
