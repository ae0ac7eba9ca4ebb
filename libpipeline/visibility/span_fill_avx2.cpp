#include "libpipeline/visibility/span_fill.h"

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#include <algorithm>

#define PIPELINE_AVX2 __attribute__((target("avx2")))

namespace pipeline {
namespace {

// Eight pixels at a time.

/// Eight doubles, or masks of 64 bits.
struct EightDoubles {
  __m256d low;
  __m256d high;
};

/// Eight depths of a format as they are stored (`Eight`), and how they are made, read, compared and written.
/// A mask is all ones for "yes", as wide as the numbers compared; functions named `_some` touch memory only
/// in the lanes of their mask. A format without a specialization has no vector kernel.
template <typename Depth>
struct Lanes;

template <>
struct Lanes<DepthF64> {
  using Eight = EightDoubles;
  using Mask = EightDoubles;
  PIPELINE_AVX2 explicit Lanes(const DepthF64&) {}
  PIPELINE_AVX2 Eight store(const EightDoubles& z) const { return z; }
  PIPELINE_AVX2 static Eight load(const double* p) { return {_mm256_loadu_pd(p), _mm256_loadu_pd(p + 4)}; }
  PIPELINE_AVX2 static Eight load_some(const double* p, const Mask& mask) {
    return {_mm256_maskload_pd(p, _mm256_castpd_si256(mask.low)),
            _mm256_maskload_pd(p + 4, _mm256_castpd_si256(mask.high))};
  }
  PIPELINE_AVX2 static Eight larger(const Eight& a, const Eight& b) {
    return {_mm256_max_pd(a.low, b.low), _mm256_max_pd(a.high, b.high)};
  }
  PIPELINE_AVX2 static double largest(const Eight& a) {
    const __m256d four = _mm256_max_pd(a.low, a.high);
    const __m128d two = _mm_max_pd(_mm256_castpd256_pd128(four), _mm256_extractf128_pd(four, 1));
    return std::max(_mm_cvtsd_f64(two), _mm_cvtsd_f64(_mm_unpackhi_pd(two, two)));
  }
  PIPELINE_AVX2 static Mask is_less(const Eight& a, const Eight& b) {
    return {_mm256_cmp_pd(a.low, b.low, _CMP_LT_OQ), _mm256_cmp_pd(a.high, b.high, _CMP_LT_OQ)};
  }
  PIPELINE_AVX2 static Mask both(const Mask& a, const Mask& b) {
    return {_mm256_and_pd(a.low, b.low), _mm256_and_pd(a.high, b.high)};
  }
  PIPELINE_AVX2 static bool is_any(const Mask& mask) {
    return _mm256_movemask_pd(_mm256_or_pd(mask.low, mask.high)) != 0;
  }
  PIPELINE_AVX2 static Mask mask_of(__m256i mask) {
    return {_mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_castsi256_si128(mask))),
            _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm256_extracti128_si256(mask, 1)))};
  }
  PIPELINE_AVX2 static __m256i in_32_bits(const Mask& mask) {
    const __m256 mixed = _mm256_shuffle_ps(_mm256_castpd_ps(mask.low), _mm256_castpd_ps(mask.high), 0x88);
    return _mm256_permute4x64_epi64(_mm256_castps_si256(mixed), 0xd8);
  }
  PIPELINE_AVX2 static void write_some(double* p, const Eight& depths, const Mask& mask) {
    _mm256_maskstore_pd(p, _mm256_castpd_si256(mask.low), depths.low);
    _mm256_maskstore_pd(p + 4, _mm256_castpd_si256(mask.high), depths.high);
  }
};

/// The masks of formats of 32 bits.
struct Masks32 {
  using Mask = __m256i;
  PIPELINE_AVX2 static Mask both(Mask a, Mask b) { return _mm256_and_si256(a, b); }
  PIPELINE_AVX2 static bool is_any(Mask mask) { return _mm256_testz_si256(mask, mask) == 0; }
  PIPELINE_AVX2 static Mask mask_of(__m256i mask) { return mask; }
  PIPELINE_AVX2 static __m256i in_32_bits(Mask mask) { return mask; }
};

template <>
struct Lanes<DepthF32> : Masks32 {
  using Eight = __m256;
  PIPELINE_AVX2 explicit Lanes(const DepthF32&) {}
  PIPELINE_AVX2 Eight store(const EightDoubles& z) const {
    return _mm256_set_m128(_mm256_cvtpd_ps(z.high), _mm256_cvtpd_ps(z.low));
  }
  PIPELINE_AVX2 static Eight load(const float* p) { return _mm256_loadu_ps(p); }
  PIPELINE_AVX2 static Eight load_some(const float* p, Mask mask) { return _mm256_maskload_ps(p, mask); }
  PIPELINE_AVX2 static Eight larger(Eight a, Eight b) { return _mm256_max_ps(a, b); }
  PIPELINE_AVX2 static float largest(Eight a) {
    const __m128 four = _mm_max_ps(_mm256_castps256_ps128(a), _mm256_extractf128_ps(a, 1));
    const __m128 two = _mm_max_ps(four, _mm_movehl_ps(four, four));
    return std::max(_mm_cvtss_f32(two), _mm_cvtss_f32(_mm_shuffle_ps(two, two, 1)));
  }
  PIPELINE_AVX2 static Mask is_less(Eight a, Eight b) {
    return _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LT_OQ));
  }
  PIPELINE_AVX2 static void write_some(float* p, Eight depths, Mask mask) {
    _mm256_maskstore_ps(p, mask, depths);
  }
};

template <>
struct Lanes<DepthU24> : Masks32 {
  using Eight = __m256i;
  PIPELINE_AVX2 explicit Lanes(const DepthU24& format)
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
  PIPELINE_AVX2 static Eight load_some(const std::int32_t* p, Mask mask) {
    return _mm256_maskload_epi32(p, mask);
  }
  PIPELINE_AVX2 static Eight larger(Eight a, Eight b) { return _mm256_max_epi32(a, b); }
  PIPELINE_AVX2 static std::int32_t largest(Eight a) {
    const __m128i four = _mm_max_epi32(_mm256_castsi256_si128(a), _mm256_extracti128_si256(a, 1));
    const __m128i two = _mm_max_epi32(four, _mm_shuffle_epi32(four, 0x4e));
    return std::max(_mm_cvtsi128_si32(two), _mm_extract_epi32(two, 1));
  }
  PIPELINE_AVX2 static Mask is_less(Eight a, Eight b) { return _mm256_cmpgt_epi32(b, a); }
  PIPELINE_AVX2 static void write_some(std::int32_t* p, Eight depths, Mask mask) {
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

/// The first `count` of eight, and all of them if there are more.
PIPELINE_AVX2 inline __m256i first_of_eight(int count) {
  return _mm256_cmpgt_epi32(_mm256_set1_epi32(count), _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
}

/// A span being drawn.
template <typename Depth>
class SpanLanes {
 public:
  PIPELINE_AVX2 explicit SpanLanes(const SpanFill<Depth>& pixels)
      : pixels_(pixels),
        lanes_(pixels.format),
        depth_(pixels.span.depth),
        is_rising_(pixels.span.depth(pixels.span.first_column) <= pixels.span.depth(pixels.span.last_column)),
        tag_(_mm256_set1_epi32(static_cast<int>(pixels.tag))) {}

  /// Draws the pixels from the column `first` to before `end`; returns whether any is visible.
  PIPELINE_AVX2 bool fill_columns(int first, int end) const {
    const __m256d eight = _mm256_set1_pd(8), four = _mm256_set1_pd(4);
    __m256d columns = _mm256_add_pd(_mm256_set1_pd(first), _mm256_setr_pd(0, 1, 2, 3));
    auto* depths = pixels_.depths + first;
    int* tags = reinterpret_cast<int*>(pixels_.tags) + first;
    bool is_any_seen = false;
    for (int left = end - first; left > 0; left -= 8, depths += 8, tags += 8) {
      const auto stored = lanes_.store({depth_(columns), depth_(_mm256_add_pd(columns, four))});
      columns = _mm256_add_pd(columns, eight);
      typename Lanes<Depth>::Mask is_seen;
      if (left >= 8) {
        is_seen = lanes_.is_less(stored, lanes_.load(depths));
      } else {
        const auto in_span = lanes_.mask_of(first_of_eight(left));
        is_seen = lanes_.both(in_span, lanes_.is_less(stored, lanes_.load_some(depths, in_span)));
      }
      if (!lanes_.is_any(is_seen)) continue;
      lanes_.write_some(depths, stored, is_seen);
      _mm256_maskstore_epi32(tags, lanes_.in_32_bits(is_seen), tag_);
      is_any_seen = true;
    }
    return is_any_seen;
  }

  /// Draws the span without its hidden blocks.
  PIPELINE_AVX2 void fill_blocks() const {
    const SpanBlocks blocks(pixels_);
    const __m256d first_column = _mm256_set1_pd(pixels_.span.first_column);
    const __m256d last_column = _mm256_set1_pd(pixels_.span.last_column);
    for (int block = blocks.first; block <= blocks.last; block += 8) {
      // The columns where the span is nearest in each of eight blocks.
      const __m256d low =
          _mm256_add_pd(_mm256_set1_pd(block * kBlockColumns + (is_rising_ ? 0 : kBlockColumns - 1)),
                        _mm256_setr_pd(0, kBlockColumns, 2 * kBlockColumns, 3 * kBlockColumns));
      const __m256d high = _mm256_add_pd(low, _mm256_set1_pd(4 * kBlockColumns));
      const auto nearest =
          lanes_.store({depth_(_mm256_min_pd(_mm256_max_pd(low, first_column), last_column)),
                        depth_(_mm256_min_pd(_mm256_max_pd(high, first_column), last_column))});
      const auto is_near = lanes_.is_less(nearest, lanes_.load(pixels_.farthest + block));
      const __m256i is_open =
          _mm256_and_si256(lanes_.in_32_bits(is_near), first_of_eight(blocks.last - block + 1));
      auto open = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(is_open)));
      while (open != 0) {
        const int begin = __builtin_ctz(open), end = begin + __builtin_ctz(~(open >> begin));
        fill_run(blocks, block + begin, block + end);
        open &= ~0u << end;
      }
    }
  }

 private:
  /// Draws into the blocks from `begin` to before `end`.
  PIPELINE_AVX2 void fill_run(const SpanBlocks& blocks, int begin, int end) const {
    const bool is_any_seen = fill_columns(std::max(begin * kBlockColumns, pixels_.span.first_column),
                                          std::min(end * kBlockColumns, pixels_.span.last_column + 1));
    if (!is_any_seen) {
      for (int block = begin; block < end; ++block) pixels_.farthest[block] = farthest_of(block);
      return;
    }
    const int end_whole = std::min(end, blocks.last_whole + 1);
    for (int block = std::max(begin, blocks.first_whole); block < end_whole; ++block) {
      const int column = block * kBlockColumns + (is_rising_ ? kBlockColumns - 1 : 0);
      const double z = pixels_.span.depth(std::min(column, pixels_.span.last_column));
      pixels_.farthest[block] = std::min(pixels_.farthest[block], pixels_.format.store(z));
    }
  }

  PIPELINE_AVX2 typename Depth::Stored farthest_of(int block) const {
    const int begin = block * kBlockColumns, count = std::min(kBlockColumns, pixels_.columns - begin);
    const auto* const depths = pixels_.depths + begin;
    if (count < kBlockColumns) return *std::max_element(depths, depths + count);
    auto farthest = lanes_.load(depths);
    for (int i = 8; i < kBlockColumns; i += 8) farthest = lanes_.larger(farthest, lanes_.load(depths + i));
    return lanes_.largest(farthest);
  }

  const SpanFill<Depth>& pixels_;
  Lanes<Depth> lanes_;
  EightDepths depth_;
  bool is_rising_;
  __m256i tag_;
};

template <typename Depth>
PIPELINE_AVX2 void fill_span(const SpanFill<Depth>& pixels) {
  const SpanLanes<Depth> lanes(pixels);
  if (pixels.farthest == nullptr)
    lanes.fill_columns(pixels.span.first_column, pixels.span.last_column + 1);
  else
    lanes.fill_blocks();
}

}  // namespace

template <typename Depth>
const SpanFillKernel<Depth>* span_fill_avx2() {
  if constexpr (requires { typename Lanes<Depth>::Eight; }) {
    static constexpr SpanFillKernel<Depth> kKernel = {"avx2", fill_span};
    return __builtin_cpu_supports("avx2") ? &kKernel : nullptr;
  }
  return nullptr;
}

#else

namespace pipeline {

template <typename Depth>
const SpanFillKernel<Depth>* span_fill_avx2() {
  return nullptr;
}

#endif

#define PIPELINE_INSTANTIATE(Depth) template const SpanFillKernel<Depth>* span_fill_avx2<Depth>();
PIPELINE_FOR_EACH_DEPTH_FORMAT(PIPELINE_INSTANTIATE)
#undef PIPELINE_INSTANTIATE

}  // namespace pipeline
