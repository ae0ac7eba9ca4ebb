#pragma once

#include <cmath>

namespace pipeline {

/// An unevaluated sum hi + lo with |lo| <= ulp(hi) / 2: about 106 bits in the range of a double.
/// The algorithms and their error bounds are from M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous
/// error bounds for basic building blocks of double-word arithmetic", ACM TOMS 44(2), 2017. Bounds are
/// multiples of u^2, u = 2^-53, relative to the exact result; they hold while nothing over- or underflows.
/// The bounds that the library relies on are proved in tests/proofs: pair_sum.g, pair_product.g,
/// pair_quotient.g, pair_root.g.
struct DoubleDouble {
  double hi = 0;
  double lo = 0;

  friend bool operator==(const DoubleDouble&, const DoubleDouble&) = default;
};

/// a + b exactly (Knuth's 2Sum). Forced inline: if GCC 12 decides, the scalar vertex loops spill registers
/// and take 1.5 % more instructions.
inline __attribute__((always_inline)) DoubleDouble two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  const double a_part = sum - b_part;
  return {sum, (a - a_part) + (b - b_part)};
}

/// a + b exactly, where |a| >= |b| or a is 0 (Dekker's Fast2Sum).
inline DoubleDouble fast_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// a * b exactly.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  return {product, std::fma(a, b, -product)};
}

/// The sum within 3 u^2 (algorithm AccurateDWPlusDW).
inline DoubleDouble operator+(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = two_sum(a.hi, b.hi);
  const DoubleDouble low = two_sum(a.lo, b.lo);
  const DoubleDouble carried = fast_two_sum(high.hi, high.lo + low.hi);
  return fast_two_sum(carried.hi, low.lo + carried.lo);
}

inline DoubleDouble operator-(DoubleDouble a) {
  return {-a.hi, -a.lo};
}
inline DoubleDouble operator-(DoubleDouble a, DoubleDouble b) {
  return a + -b;
}

/// The product within 5 u^2 (algorithm DWTimesDW2).
inline DoubleDouble operator*(DoubleDouble a, DoubleDouble b) {
  const DoubleDouble high = two_product(a.hi, b.hi);
  const double cross = std::fma(a.lo, b.hi, a.hi * b.lo);
  return fast_two_sum(high.hi, high.lo + cross);
}

/// The product within 2 u^2 (algorithm DWTimesFP3).
inline DoubleDouble operator*(DoubleDouble a, double b) {
  const DoubleDouble high = two_product(a.hi, b);
  return fast_two_sum(high.hi, std::fma(a.lo, b, high.lo));
}

/// The quotient within 16 u^2: one correction of a double quotient (15 u^2, algorithm DWDivDW2).
inline DoubleDouble operator/(DoubleDouble a, DoubleDouble b) {
  const double quotient = a.hi / b.hi;
  const DoubleDouble back = b * quotient;
  const double rest = (a.hi - back.hi) + (a.lo - back.lo);
  return fast_two_sum(quotient, rest / b.hi);
}

/// The root within 4 u^2: one Newton step on the double root (algorithm SQRTDWtoDW: V. Lefevre, N. Louvet,
/// J.-M. Muller, J. Picot, L. Rideau, "Accurate calculation of Euclidean norms", ACM TOMS 49(1), 2023). `a`
/// must not be negative.
inline DoubleDouble sqrt(DoubleDouble a) {
  if (a.hi == 0) return {0, 0};
  const double root = std::sqrt(a.hi);
  const double rest = std::fma(-root, root, a.hi) + a.lo;
  return fast_two_sum(root, rest / (2 * root));
}

}  // namespace pipeline
