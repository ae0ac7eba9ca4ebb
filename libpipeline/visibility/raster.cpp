#include "libpipeline/visibility/raster.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace pipeline {

void prefer_large_pages([[maybe_unused]] void* begin, [[maybe_unused]] std::size_t size) {
#ifdef MADV_HUGEPAGE
  // What is less than a large page at the end stays on small ones: memory is not taken that is not asked for.
  madvise(begin, size, MADV_HUGEPAGE);
#endif
}

}  // namespace pipeline
