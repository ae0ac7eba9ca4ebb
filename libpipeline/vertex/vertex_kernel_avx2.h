#pragma once

#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// The kernel "avx2": four vertices at a time, with fused multiply-adds. Null where the processor lacks them.
const VertexKernel* vertex_kernel_avx2();

}  // namespace pipeline
