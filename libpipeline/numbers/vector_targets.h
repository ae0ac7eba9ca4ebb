// No include guard: a kernel's source includes this once for each target, after
//   #undef HWY_TARGET_INCLUDE
//   #define HWY_TARGET_INCLUDE "path/of/this/source.cpp"
// Code between PIPELINE_BEGIN_KERNELS and PIPELINE_END_KERNELS is compiled for every target, the rest, in
// `#if HWY_ONCE`, once.

#ifndef PIPELINE_VECTOR_TARGETS
#define PIPELINE_VECTOR_TARGETS
// The targets of kernel_choice.h: all of them in packages and where the tests compare them. A source may
// define fewer.
#ifdef PIPELINE_ALL_KERNELS
#define PIPELINE_MORE_TARGETS (HWY_SSE4 | HWY_AVX3)
#else
#define PIPELINE_MORE_TARGETS 0
#endif
#ifndef PIPELINE_TARGETS
#define PIPELINE_TARGETS (HWY_SCALAR | HWY_NEON | HWY_WASM | HWY_AVX2 | PIPELINE_MORE_TARGETS)
#endif
#define HWY_DISABLED_TARGETS (~PIPELINE_TARGETS)
#define HWY_COMPILE_ALL_ATTAINABLE
// Scalar code with every compiler, not emulated vectors of 128 bits.
#define HWY_BROKEN_EMU128 1
// No kernel uses these, so no processor needs them.
#define HWY_DISABLE_PCLMUL_AES
#define HWY_DISABLE_F16C
// On Arm, nothing is chosen at run time: every processor of 64 bits has NEON.
#define TOOLCHAIN_MISS_SYS_AUXV_H
// Highway's assertions, in unoptimized or sanitizer builds, would call a library that is not linked.
#define HWY_IS_DEBUG_BUILD 0

// For a function that is copied to many callers. Builds with sanitizers, whose checks make each copy many
// times as long, leave the choice to the compiler.
#ifndef PIPELINE_INLINE
#define PIPELINE_INLINE HWY_INLINE
#endif

#define PIPELINE_BEGIN_KERNELS() \
  HWY_BEFORE_NAMESPACE();        \
  namespace pipeline {           \
  namespace HWY_NAMESPACE {      \
  namespace {                    \
  static_assert(true)
#define PIPELINE_END_KERNELS() \
  }                            \
  }                            \
  }                            \
  HWY_AFTER_NAMESPACE()
#endif

#include <hwy/foreach_target.h>  // first
#include <hwy/highway.h>
