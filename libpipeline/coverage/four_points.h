#pragma once

#include "libpipeline/coverage/four_doubles.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <array>
#include <cstddef>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A point of each of four triangles.
struct FourPoints {
  /// One of them, four times.
  PIPELINE_AVX2_INLINE FourPoints of(std::size_t lane) const {
    return {all(x[lane]), all(y[lane]), all(z[lane])};
  }

  FourDoubles x;
  FourDoubles y;
  FourDoubles z;
};

/// The vertices of four triangles.
PIPELINE_AVX2_INLINE std::array<FourPoints, 3> vertices_of(const TaggedTriangle* triangles) {
  static_assert(sizeof(Triangle) == 9 * sizeof(double));
  const double* const p = &triangles[0].triangle.p_ndc[0].x;
  const double* const q = &triangles[1].triangle.p_ndc[0].x;
  const double* const r = &triangles[2].triangle.p_ndc[0].x;
  const double* const s = &triangles[3].triangle.p_ndc[0].x;
  // Two neighboring coordinates of all four.
  const auto pair = [&](std::size_t i, FourDoubles& first, FourDoubles& second) PIPELINE_AVX2 {
    const FourDoubles even = _mm256_loadu2_m128d(r + i, p + i), odd = _mm256_loadu2_m128d(s + i, q + i);
    first = _mm256_unpacklo_pd(even, odd);
    second = _mm256_unpackhi_pd(even, odd);
  };
  std::array<FourPoints, 3> result;
  pair(0, result[0].x, result[0].y);
  pair(2, result[0].z, result[1].x);
  pair(4, result[1].y, result[1].z);
  pair(6, result[2].x, result[2].y);
  result[2].z = _mm256_setr_pd(p[8], q[8], r[8], s[8]);
  return result;
}

}  // namespace pipeline

#endif
