#include "libpipeline/span_fill_avx2.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#include "libpipeline/span_fill_loop.h"

#define PIPELINE_AVX2 __attribute__((target("avx2")))

namespace pipeline {
namespace {

// Eight pixels at a time. What decides on them is a mask of eight numbers of 32 bits, all ones for "yes".

/// Eight doubles, or masks of 64 bits.
struct EightDoubles {
  __m256d low;
  __m256d high;
};

PIPELINE_AVX2 inline __m256i narrow_mask(__m256d low, __m256d high) {
  const __m256 mixed = _mm256_shuffle_ps(_mm256_castpd_ps(low), _mm256_castpd_ps(high), 0x88);
  return _mm256_permute4x64_epi64(_mm256_castps_si256(mixed), 0xd8);
}

PIPELINE_AVX2 inline __m256i low_mask(__m256i mask) {
  return _mm256_cvtepi32_epi64(_mm256_castsi256_si128(mask));
}
PIPELINE_AVX2 inline __m256i high_mask(__m256i mask) {
  return _mm256_cvtepi32_epi64(_mm256_extracti128_si256(mask, 1));
}

// For each format: what is stored of eight depths, and how it is read, compared and written. `_some` touch
// only memory where the mask says so.

struct LanesF64 {
  using Eight = EightDoubles;
  PIPELINE_AVX2 explicit LanesF64(const DepthF64&) {}
  PIPELINE_AVX2 Eight store(const EightDoubles& z) const { return z; }
  PIPELINE_AVX2 static Eight load(const double* p) { return {_mm256_loadu_pd(p), _mm256_loadu_pd(p + 4)}; }
  PIPELINE_AVX2 static Eight load_some(const double* p, __m256i mask) {
    return {_mm256_maskload_pd(p, low_mask(mask)), _mm256_maskload_pd(p + 4, high_mask(mask))};
  }
  PIPELINE_AVX2 static __m256i is_less(const Eight& a, const Eight& b) {
    return narrow_mask(_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ), _mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ));
  }
  PIPELINE_AVX2 static void write_some(double* p, const Eight& depths, __m256i mask) {
    _mm256_maskstore_pd(p, low_mask(mask), depths.low);
    _mm256_maskstore_pd(p + 4, high_mask(mask), depths.high);
  }
};

struct LanesF32 {
  using Eight = __m256;
  PIPELINE_AVX2 explicit LanesF32(const DepthF32&) {}
  PIPELINE_AVX2 Eight store(const EightDoubles& z) const {
    return _mm256_set_m128(_mm256_cvtpd_ps(z.high), _mm256_cvtpd_ps(z.low));
  }
  PIPELINE_AVX2 static Eight load(const float* p) { return _mm256_loadu_ps(p); }
  PIPELINE_AVX2 static Eight load_some(const float* p, __m256i mask) { return _mm256_maskload_ps(p, mask); }
  PIPELINE_AVX2 static __m256i is_less(Eight a, Eight b) {
    return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
  }
  PIPELINE_AVX2 static void write_some(float* p, Eight depths, __m256i mask) {
    _mm256_maskstore_ps(p, mask, depths);
  }
};

struct LanesU24 {
  using Eight = __m256i;
  PIPELINE_AVX2 explicit LanesU24(const DepthU24& format)
      : front(_mm256_set1_pd(format.front)), steps_per_depth(_mm256_set1_pd(format.steps_per_depth)) {}
  PIPELINE_AVX2 __m128i store(__m256d z) const {
    const __m256d steps =
        _mm256_add_pd(_mm256_mul_pd(_mm256_sub_pd(z, front), steps_per_depth), _mm256_set1_pd(0.5));
    const __m256d steps_from_front = _mm256_max_pd(steps, _mm256_setzero_pd());
    return _mm256_cvttpd_epi32(_mm256_min_pd(_mm256_set1_pd(DepthU24::kSteps), steps_from_front));
  }
  PIPELINE_AVX2 Eight store(const EightDoubles& z) const {
    return _mm256_set_m128i(store(z.high), store(z.low));
  }
  PIPELINE_AVX2 static Eight load(const std::int32_t* p) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
  }
  PIPELINE_AVX2 static Eight load_some(const std::int32_t* p, __m256i mask) {
    return _mm256_maskload_epi32(p, mask);
  }
  PIPELINE_AVX2 static __m256i is_less(Eight a, Eight b) { return _mm256_cmpgt_epi32(b, a); }
  PIPELINE_AVX2 static void write_some(std::int32_t* p, Eight depths, __m256i mask) {
    _mm256_maskstore_epi32(p, mask, depths);
  }

  __m256d front;
  __m256d steps_per_depth;
};

/// SpanDepth for eight columns: the same roundings in the same order.
struct EightDepths {
  PIPELINE_AVX2 explicit EightDepths(const SpanDepth& depth)
      : left_x(_mm256_set1_pd(depth.left_x)),
        dx(_mm256_set1_pd(depth.dx)),
        x0(_mm256_set1_pd(depth.x0)),
        z0(_mm256_set1_pd(depth.z0)),
        slope(_mm256_set1_pd(depth.slope)) {}
  PIPELINE_AVX2 __m256d operator()(__m256d columns) const {
    const __m256d x = _mm256_sub_pd(_mm256_add_pd(left_x, _mm256_mul_pd(columns, dx)), x0);
    return _mm256_add_pd(z0, _mm256_mul_pd(x, slope));
  }

  __m256d left_x, dx, x0, z0, slope;
};

PIPELINE_AVX2 inline bool is_any(__m256i mask) {
  return _mm256_testz_si256(mask, mask) == 0;
}

/// The first `count` of eight, and all of them if there are more.
PIPELINE_AVX2 inline __m256i first_of_eight(int count) {
  return _mm256_cmpgt_epi32(_mm256_set1_epi32(count), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}

template <typename Lanes, typename Depth>
PIPELINE_AVX2 void fill_span(const SpanFill<Depth>& pixels) {
  const Lanes lanes(pixels.format);
  const EightDepths depth(pixels.span.depth);
  const __m256d front = _mm256_set1_pd(pixels.front);
  const __m256d eight = _mm256_set1_pd(8), four = _mm256_set1_pd(4);
  const __m256i color = _mm256_set1_epi32(static_cast<int>(pixels.color.rgb()));
  __m256d columns = _mm256_add_pd(_mm256_set1_pd(pixels.span.first_column), _mm256_setr_pd(0, 1, 2, 3));
  auto* depths = pixels.depths;
  int* colors = reinterpret_cast<int*>(pixels.colors);
  int left = pixels.span.last_column - pixels.span.first_column + 1;
  for (; left > 0; left -= 8, depths += 8, colors += 8, columns = _mm256_add_pd(columns, eight)) {
    const EightDoubles z = {depth(columns), depth(_mm256_add_pd(columns, four))};
    const __m256i in_front =
        narrow_mask(_mm256_cmp_pd(z.low, front, _CMP_GE_OQ), _mm256_cmp_pd(z.high, front, _CMP_GE_OQ));
    const __m256i in_span = first_of_eight(left);
    const auto stored = lanes.store(z);
    const auto old = left >= 8 ? lanes.load(depths) : lanes.load_some(depths, in_span);
    const __m256i is_seen = _mm256_and_si256(_mm256_and_si256(in_front, in_span), lanes.is_less(stored, old));
    if (!is_any(is_seen)) continue;
    lanes.write_some(depths, stored, is_seen);
    _mm256_maskstore_epi32(colors, is_seen, color);
  }
}

/// A few pixels are done before eight could be set up.
template <typename Lanes, typename Depth>
void fill_short_or_long_span(const SpanFill<Depth>& pixels) {
  constexpr int kShort = 3;
  if (pixels.span.last_column - pixels.span.first_column < kShort)
    fill_span_in_a_loop(pixels);
  else
    fill_span<Lanes>(pixels);
}

constexpr SpanFillKernel kAvx2Kernel = {"avx2", fill_short_or_long_span<LanesF64, DepthF64>,
                                        fill_short_or_long_span<LanesF32, DepthF32>,
                                        fill_short_or_long_span<LanesU24, DepthU24>};

}  // namespace

const SpanFillKernel* span_fill_avx2() {
  return __builtin_cpu_supports("avx2") ? &kAvx2Kernel : nullptr;
}

}  // namespace pipeline

#else

namespace pipeline {

const SpanFillKernel* span_fill_avx2() {
  return nullptr;
}

}  // namespace pipeline

#endif
