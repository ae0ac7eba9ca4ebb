#pragma once

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pipeline {

/// Two doubles, calculated with at a time where the processor can. Comparisons with NaN fail.
class TwoDoubles {
 public:
#if defined(__SSE2__)
  explicit TwoDoubles(double both) : values_(_mm_set1_pd(both)) {}
  /// The two floats at `p`.
  static TwoDoubles from_floats(const float* p) {
    return TwoDoubles(_mm_cvtps_pd(_mm_castpd_ps(_mm_load_sd(reinterpret_cast<const double*>(p)))));
  }
  friend TwoDoubles operator-(const TwoDoubles& a, const TwoDoubles& b) {
    return TwoDoubles(_mm_sub_pd(a.values_, b.values_));
  }
  friend TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b) {
    return TwoDoubles(_mm_mul_pd(a.values_, b.values_));
  }
  /// a where it is greater, otherwise b.
  friend TwoDoubles greater(const TwoDoubles& a, const TwoDoubles& b) {
    return TwoDoubles(_mm_max_pd(a.values_, b.values_));
  }
  friend TwoDoubles less(const TwoDoubles& a, const TwoDoubles& b) {
    return TwoDoubles(_mm_min_pd(a.values_, b.values_));
  }
  /// Bit 0 and bit 1: whether the first and the second are at most those of `b`.
  friend int at_most(const TwoDoubles& a, const TwoDoubles& b) {
    return _mm_movemask_pd(_mm_cmple_pd(a.values_, b.values_));
  }
  [[nodiscard]] double first() const {
    return _mm_cvtsd_f64(values_);
  }
  [[nodiscard]] double second() const {
    return _mm_cvtsd_f64(_mm_unpackhi_pd(values_, values_));
  }

 private:
  explicit TwoDoubles(__m128d values) : values_(values) {}

  __m128d values_;
#else
  explicit TwoDoubles(double both) : first_(both), second_(both) {}
  static TwoDoubles from_floats(const float* p) {
    return {p[0], p[1]};
  }
  friend TwoDoubles operator-(const TwoDoubles& a, const TwoDoubles& b) {
    return {a.first_ - b.first_, a.second_ - b.second_};
  }
  friend TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b) {
    return {a.first_ * b.first_, a.second_ * b.second_};
  }
  friend TwoDoubles greater(const TwoDoubles& a, const TwoDoubles& b) {
    return {a.first_ > b.first_ ? a.first_ : b.first_, a.second_ > b.second_ ? a.second_ : b.second_};
  }
  friend TwoDoubles less(const TwoDoubles& a, const TwoDoubles& b) {
    return {a.first_ < b.first_ ? a.first_ : b.first_, a.second_ < b.second_ ? a.second_ : b.second_};
  }
  friend int at_most(const TwoDoubles& a, const TwoDoubles& b) {
    return (a.first_ <= b.first_ ? 1 : 0) + (a.second_ <= b.second_ ? 2 : 0);
  }
  [[nodiscard]] double first() const {
    return first_;
  }
  [[nodiscard]] double second() const {
    return second_;
  }

 private:
  TwoDoubles(double first, double second) : first_(first), second_(second) {}

  double first_, second_;
#endif
};

}  // namespace pipeline
