#pragma once

#include "libpipeline/coverage/four_doubles.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <array>
#include <cstddef>

#include "libpipeline/coverage/exact_grid.h"

namespace pipeline {

/// Four spans that kernels find in four lanes, each kept in few pieces laid out as they will be in memory.
class FourSpans {
 public:
  /// There is a span where the last column is not before the first.
  PIPELINE_AVX2_INLINE void set_columns(FourDoubles row, FourDoubles first, FourDoubles last) {
    const __m128i rows = _mm256_cvtpd_epi32(row), firsts = _mm256_cvtpd_epi32(first);
    const __m128i lasts = _mm256_cvtpd_epi32(last);
    const __m128i size = _mm_set1_epi32(sizeof(TaggedSpan));
    const __m128i step = _mm_andnot_si128(_mm_cmpgt_epi32(firsts, lasts), size);
    const __m128i low = _mm_unpacklo_epi32(rows, firsts), high = _mm_unpackhi_epi32(rows, firsts);
    const __m128i low_ends = _mm_unpacklo_epi32(lasts, step), high_ends = _mm_unpackhi_epi32(lasts, step);
    store(0, _mm_unpacklo_epi64(low, low_ends));
    store(1, _mm_unpackhi_epi64(low, low_ends));
    store(2, _mm_unpacklo_epi64(high, high_ends));
    store(3, _mm_unpackhi_epi64(high, high_ends));
  }
  /// The points where depths are known.
  PIPELINE_AVX2_INLINE void set_points(FourDoubles x0, FourDoubles z0) {
    const FourDoubles even = _mm256_unpacklo_pd(x0, z0), odd = _mm256_unpackhi_pd(x0, z0);
    lanes_[0].point = _mm256_castpd256_pd128(even);
    lanes_[1].point = _mm256_castpd256_pd128(odd);
    lanes_[2].point = _mm256_extractf128_pd(even, 1);
    lanes_[3].point = _mm256_extractf128_pd(odd, 1);
  }

  /// Writes one of them to `spans`; returns where the next one goes, which is `spans` again if this one has
  /// no pixel. `axis` is left_x and dx of its depth. Branch-free: whether it has one is unpredictable.
  PIPELINE_AVX2_INLINE TaggedSpan* append(std::size_t lane, __m128d axis, double slope, PixelTag tag,
                                          TaggedSpan* spans) const {
    static_assert(offsetof(Span, row) == 0 && offsetof(Span, first_column) == 4);
    static_assert(offsetof(Span, last_column) == 8 && offsetof(Span, depth) == 16);
    static_assert(offsetof(SpanDepth, left_x) == 0 && offsetof(SpanDepth, dx) == 8);
    static_assert(offsetof(SpanDepth, x0) == 16 && offsetof(SpanDepth, z0) == 24);
    const Lane& stored = lanes_[lane];
    Span& span = spans->span;
    // The fourth number falls between the columns and the depth.
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&span.row), load(stored.columns));
    _mm_storeu_pd(&span.depth.left_x, axis);
    _mm_storeu_pd(&span.depth.x0, stored.point);
    span.depth.slope = slope;
    spans->tag = tag;
    return reinterpret_cast<TaggedSpan*>(reinterpret_cast<char*>(spans) + stored.columns[3]);
  }

 private:
  // Row, first and last column, and the size of a span if there is one, else 0.
  using Columns = std::array<int, 4>;
  struct Lane {
    alignas(16) Columns columns;
    __m128d point;
  };

  PIPELINE_AVX2_INLINE void store(std::size_t lane, __m128i columns) {
    _mm_store_si128(reinterpret_cast<__m128i*>(lanes_[lane].columns.data()), columns);
  }
  PIPELINE_AVX2_INLINE static __m128i load(const Columns& columns) {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(columns.data()));
  }

  std::array<Lane, 4> lanes_;
};

}  // namespace pipeline

#endif
