#pragma once

#include <mpfr.h>

#include <array>
#include <cstdlib>
#include <ostream>
#include <string>

#include "libpipeline/numbers/ball.h"

namespace pipeline {

/// MPFR's floating-point number with `bits` bits and unlimited exponent, as a value: the tests' reference.
/// The digits are stored in the object, so millions of numbers need no allocation.
template <int bits>
class Real {
 public:
  Real() { mpfr_custom_init_set(value_, MPFR_ZERO_KIND, 0, bits, limbs_.data()); }
  Real(double value) : Real() {
    mpfr_set_d(value_, value, MPFR_RNDN);
  }  // NOLINT(google-explicit-constructor)
  Real(DoubleDouble value) : Real(value.hi) { mpfr_add_d(value_, value_, value.lo, MPFR_RNDN); }  // NOLINT
  Real(const Real& other) : Real() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  Real& operator=(const Real& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~Real() = default;

  /// The number nearest to a number of another precision.
  template <int other_bits>
  static Real nearest(const Real<other_bits>& other) {
    Real result;
    mpfr_set(result.value_, other.value_, MPFR_RNDN);
    return result;
  }

  static Real pi() {
    Real result;
    mpfr_const_pi(result.value_, MPFR_RNDN);
    return result;
  }

  friend Real operator+(const Real& a, const Real& b) { return apply(mpfr_add, a, b); }
  friend Real operator-(const Real& a, const Real& b) { return apply(mpfr_sub, a, b); }
  friend Real operator*(const Real& a, const Real& b) { return apply(mpfr_mul, a, b); }
  friend Real operator/(const Real& a, const Real& b) { return apply(mpfr_div, a, b); }
  friend Real operator-(const Real& a) { return apply(mpfr_neg, a); }
  friend Real abs(const Real& a) { return apply(mpfr_abs, a); }
  friend Real sqrt(const Real& a) { return apply(mpfr_sqrt, a); }
  friend Real sin(const Real& a) { return apply(mpfr_sin, a); }
  friend Real cos(const Real& a) { return apply(mpfr_cos, a); }
  friend Real tan(const Real& a) { return apply(mpfr_tan, a); }
  /// The remainder of a / b with the sign of a, exactly.
  friend Real remainder(const Real& a, const Real& b) { return apply(mpfr_fmod, a, b); }
  friend Real times_power_of_two(const Real& a, long exponent) {
    Real result;
    mpfr_mul_2si(result.value_, a.value_, exponent, MPFR_RNDN);
    return result;
  }
  /// The nearest number with `fewer_bits` bits.
  friend Real rounded_to_bits(const Real& a, int fewer_bits) {
    Real result(a);
    mpfr_prec_round(result.value_, fewer_bits, MPFR_RNDN);
    Real whole;
    mpfr_set(whole.value_, result.value_, MPFR_RNDN);
    return whole;
  }
  /// The nearest whole number, ties to even.
  friend Real round_to_even(const Real& a) { return apply(mpfr_rint_roundeven, a); }

  friend bool operator==(const Real& a, const Real& b) { return mpfr_equal_p(a.value_, b.value_) != 0; }
  friend auto operator<=>(const Real& a, const Real& b) { return mpfr_cmp(a.value_, b.value_) <=> 0; }

  [[nodiscard]] int sign() const { return mpfr_sgn(value_); }
  [[nodiscard]] double nearest_double() const { return mpfr_get_d(value_, MPFR_RNDN); }
  [[nodiscard]] long nearest_long() const { return mpfr_get_si(value_, MPFR_RNDN); }

  /// The text with `decimals` decimals, ties to even, without a negative zero's sign.
  [[nodiscard]] std::string text(int decimals) const {
    char* printed = nullptr;
    mpfr_asprintf(&printed, "%.*RNf", decimals, value_);
    std::string result = printed;
    mpfr_free_str(printed);
    const bool is_zero = result.find_first_of("123456789") == std::string::npos;
    return is_zero && result.front() == '-' ? result.substr(1) : result;
  }
  /// 40 significant digits, for messages.
  friend std::ostream& operator<<(std::ostream& out, const Real& a) {
    char* printed = nullptr;
    mpfr_asprintf(&printed, "%.40Rg", a.value_);
    out << printed;
    mpfr_free_str(printed);
    return out;
  }

 private:
  template <int other_bits>
  friend class Real;

  template <typename Function, typename... Operands>
  static Real apply(Function function, const Operands&... operands) {
    Real result;
    function(result.value_, operands.value_..., MPFR_RNDN);
    return result;
  }

  std::array<mp_limb_t, (bits + 63) / 64> limbs_;
  mpfr_t value_;
};

template <int bits>
Real<bits> midpoint(const Ball& ball) {
  return times_power_of_two(Real<bits>(ball.value()), static_cast<long>(ball.exponent()));
}

template <int bits>
Real<bits> radius(const Ball& ball) {
  return times_power_of_two(Real<bits>(ball.error()), static_cast<long>(ball.exponent()));
}

/// True if the ball contains a number within `slack` of `truth`.
template <int bits>
bool contains(const Ball& ball, const Real<bits>& truth, const Real<bits>& slack) {
  return abs(midpoint<bits>(ball) - truth) <= radius<bits>(ball) + slack;
}

/// contains() for a truth whose last 20 bits may be wrong.
template <int bits>
bool contains(const Ball& ball, const Real<bits>& truth) {
  return contains(ball, truth, abs(times_power_of_two(truth, 20 - bits)));
}

}  // namespace pipeline
