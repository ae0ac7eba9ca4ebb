#pragma once

#if defined(__x86_64__) && defined(__GNUC__)

#include <immintrin.h>

#include <algorithm>
#include <array>

#define PIPELINE_AVX2 __attribute__((target("avx2")))
// Inlined, so that everything stays in registers.
#define PIPELINE_AVX2_INLINE PIPELINE_AVX2 inline __attribute__((always_inline))

namespace pipeline {

// Operations for kernels that work on four doubles at a time: + - * / are the processor's, lane by lane. A
// mask has all bits set in a lane for "yes".

using FourDoubles = __m256d;

PIPELINE_AVX2_INLINE FourDoubles all(double value) {
  return _mm256_set1_pd(value);
}
PIPELINE_AVX2_INLINE FourDoubles is_less(FourDoubles a, FourDoubles b) {
  return _mm256_cmp_pd(a, b, _CMP_LT_OQ);
}
PIPELINE_AVX2_INLINE FourDoubles is_at_most(FourDoubles a, FourDoubles b) {
  return _mm256_cmp_pd(a, b, _CMP_LE_OQ);
}
PIPELINE_AVX2_INLINE FourDoubles is_equal(FourDoubles a, FourDoubles b) {
  return _mm256_cmp_pd(a, b, _CMP_EQ_OQ);
}
PIPELINE_AVX2_INLINE FourDoubles both(FourDoubles a, FourDoubles b) {
  return _mm256_and_pd(a, b);
}
PIPELINE_AVX2_INLINE FourDoubles either(FourDoubles a, FourDoubles b) {
  return _mm256_or_pd(a, b);
}
PIPELINE_AVX2_INLINE FourDoubles but_not(FourDoubles a, FourDoubles b) {
  return _mm256_andnot_pd(b, a);
}
PIPELINE_AVX2_INLINE FourDoubles pick(FourDoubles mask, FourDoubles yes, FourDoubles no) {
  return _mm256_blendv_pd(no, yes, mask);
}
/// One bit per lane.
PIPELINE_AVX2_INLINE int bits_of(FourDoubles mask) {
  return _mm256_movemask_pd(mask);
}

PIPELINE_AVX2_INLINE FourDoubles size_of(FourDoubles value) {
  return but_not(value, all(-0.0));
}
/// std::min(a, b) and std::max(a, b) for numbers.
PIPELINE_AVX2_INLINE FourDoubles smaller(FourDoubles a, FourDoubles b) {
  return _mm256_min_pd(b, a);
}
PIPELINE_AVX2_INLINE FourDoubles larger(FourDoubles a, FourDoubles b) {
  return _mm256_max_pd(b, a);
}
PIPELINE_AVX2_INLINE FourDoubles clamped(FourDoubles value, double low, double high) {
  return smaller(larger(value, all(low)), all(high));
}

// Access to single lanes.

using FourNumbers = std::array<double, 4>;

PIPELINE_AVX2_INLINE FourNumbers numbers_of(FourDoubles value) {
  FourNumbers numbers;
  _mm256_storeu_pd(numbers.data(), value);
  return numbers;
}
PIPELINE_AVX2_INLINE double largest_of(FourDoubles value) {
  const FourNumbers numbers = numbers_of(value);
  return std::max(std::max(numbers[0], numbers[1]), std::max(numbers[2], numbers[3]));
}

}  // namespace pipeline

#endif
