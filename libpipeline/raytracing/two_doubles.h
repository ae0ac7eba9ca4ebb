#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace pipeline {

/// Two doubles, calculated with at a time where the processor can: + - * and [i] are the compiler's.
/// Comparisons with NaN fail.
typedef double TwoDoubles __attribute__((vector_size(16)));

inline TwoDoubles both(double value) {
  const TwoDoubles values = {value, value};
  return values;
}

/// The two floats at `p`.
inline TwoDoubles from_floats(const float* p) {
#ifdef __SSE2__
  return _mm_cvtps_pd(_mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p))));
#else
  const TwoDoubles values = {p[0], p[1]};
  return values;
#endif
}

/// a where it is greater, otherwise b.
inline TwoDoubles greater(TwoDoubles a, TwoDoubles b) {
  return a > b ? a : b;
}
inline TwoDoubles less(TwoDoubles a, TwoDoubles b) {
  return a < b ? a : b;
}

/// Bit 0 and bit 1: whether the first and the second are at most those of `b`.
inline int at_most(TwoDoubles a, TwoDoubles b) {
#ifdef __SSE2__
  return _mm_movemask_pd(reinterpret_cast<__m128d>(a <= b));
#else
  return (a[0] <= b[0] ? 1 : 0) + (a[1] <= b[1] ? 2 : 0);
#endif
}

}  // namespace pipeline
