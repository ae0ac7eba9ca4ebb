#pragma once

#include "libpipeline/fixed_text.h"

#if defined(__x86_64__) && defined(__GNUC__)
#define PIPELINE_HAS_X86_KERNELS
#endif

namespace pipeline {

// The kernels behind fixed_text.h, each in a file of its own.

extern const FixedTextKernel kPortableKernel;

#ifdef PIPELINE_HAS_X86_KERNELS
extern const FixedTextKernel kSse4Kernel;
bool processor_has_sse4();
// Reading gains nothing from wider registers: the place of a number depends on the one before it.
extern const WriteFixedText kWriteFixedTextAvx2;
bool processor_has_avx2();
#endif

}  // namespace pipeline
