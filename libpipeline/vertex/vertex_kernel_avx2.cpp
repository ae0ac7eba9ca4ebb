#include "libpipeline/vertex/vertex_kernel_avx2.h"

#include "libpipeline/vertex/vertex_loops.h"

namespace pipeline {

#if defined(__x86_64__) && defined(__GNUC__)

namespace {

__attribute__((target("avx2,fma"))) void transform(const AffineCoefficients& m, const CoordinateTest& test,
                                                   const VertexBlock& p, ImageBlock& image) {
  transform_block<FmaError>(m, test, p, image);
}

__attribute__((target("avx2,fma"))) void project(const ProjectionCoefficients& m, const CoordinateTest& test,
                                                 const VertexBlock& p, ImageBlock& p_ndc) {
  project_block<FmaError>(m, test, p, p_ndc);
}

constexpr VertexKernel kKernel = {"avx2", transform, project};

}  // namespace

const VertexKernel* vertex_kernel_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? &kKernel : nullptr;
}

#else

const VertexKernel* vertex_kernel_avx2() {
  return nullptr;
}

#endif

}  // namespace pipeline
