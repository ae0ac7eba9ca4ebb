#pragma once

#include <cstdint>

#include "libpipeline/numbers/double_double.h"
#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A real number known to lie within `error` of a midpoint: (hi + lo +- error) * 2^exponent.
///
/// The midpoint has about 106 bits, and every operation adds its own rounding error to the error, so every
/// result carries a bound on its error ("ball arithmetic": J. van der Hoeven, 2009). The exponent is used
/// only near the ends of a double's range: it is 0 while |hi| lies in [2^-300, 2^300], so that no
/// intermediate step can overflow or underflow. Exact operations on exact numbers stay exact (error 0): the
/// product of two doubles, the sum of two that are at most 600 binary places apart, a quotient or root that
/// is a double.
class Ball {
 public:
  constexpr Ball() = default;
  /// Exactly `value`, which must be finite; subnormal numbers included.
  Ball(double value);  // NOLINT(google-explicit-constructor): a double is a ball of radius 0
  /// (value +- error) * 2^exponent, value and error within the normal range of a double.
  static Ball with_error(DoubleDouble value, double error, std::int64_t exponent = 0) {
    const double size = std::fabs(value.hi);
    if (exponent == 0 && size <= kSafeMax && size >= kSafeMin && error <= size) return {value, error, 0};
    return normalized(value, error, exponent);
  }

  friend Ball operator+(const Ball& a, const Ball& b) {
    if (a.is_exact_zero()) return b;
    if (b.is_exact_zero()) return a;
    if ((a.exponent_ | b.exponent_) != 0) return add_across_ranges(a, b);
    return add_parts(a.value_, a.error_, b.value_, b.error_, 0);
  }
  friend Ball operator*(const Ball& a, const Ball& b);
  /// The quotient; `b` must not contain 0.
  friend Ball operator/(const Ball& a, const Ball& b);
  /// `a` must not be certainly negative; if it contains 0, the root is [0, root of its upper end].
  friend Ball sqrt(const Ball& a);
  friend Ball operator-(const Ball& a);
  friend Ball operator-(const Ball& a, const Ball& b) { return a + -b; }
  /// True if midpoints and errors are equal.
  friend bool operator==(const Ball& a, const Ball& b) = default;

  /// The ball with its error reduced to at most `bound`, which the caller has proved.
  [[nodiscard]] Ball with_error_at_most(double bound) const;
  /// An upper bound on |x| for every x in the ball; infinite beyond a double's range.
  [[nodiscard]] double magnitude() const { return scaled_up(std::fabs(value_.hi) + error_); }
  /// An upper bound on the radius.
  [[nodiscard]] double radius() const { return error_ == 0 ? 0 : scaled_up(error_); }

  /// -1, 0 or +1; 0 if the ball contains 0 or nearly does.
  [[nodiscard]] int sign() const;
  [[nodiscard]] bool is_exact() const { return error_ == 0; }
  [[nodiscard]] bool is_exact_zero() const { return value_.hi == 0 && error_ == 0; }

  /// The midpoint's parts without the factor 2^exponent.
  [[nodiscard]] DoubleDouble value() const { return value_; }
  [[nodiscard]] double error() const { return error_; }
  [[nodiscard]] std::int64_t exponent() const { return exponent_; }

  /// The nearest double to the midpoint, where the low part breaks ties; +-infinity above a double's range, 0
  /// or a subnormal number below it.
  [[nodiscard]] double nearest_double() const;

 private:
  // Relative error bounds of the double-double operations, with room for the rounding of the error itself
  // (tests/proofs/ball.g).
  static constexpr double kAddMulBound = 0x1p-103;
  static constexpr double kDivSqrtBound = 0x1p-101;
  // Errors are summed in doubles; this factor exceeds what a sum of a few terms can lose by rounding.
  static constexpr double kRoundUp = 1 + 0x1p-40;
  static constexpr int kSafeExponent = 300;
  static constexpr double kSafeMax = 0x1p300;
  static constexpr double kSafeMin = 0x1p-300;

  Ball(DoubleDouble value, double error, std::int64_t exponent)
      : value_(value), error_(error), exponent_(exponent) {}

  /// The ball with an exponent as the class guarantees it: the general case of with_error.
  static Ball normalized(DoubleDouble value, double error, std::int64_t exponent);
  static Ball add_across_ranges(const Ball& a, const Ball& b);
  static Ball add_parts(DoubleDouble a, double a_error, DoubleDouble b, double b_error,
                        std::int64_t exponent) {
    const bool is_exact = a.lo == 0 && b.lo == 0 && a_error == 0 && b_error == 0;
    const DoubleDouble sum = a + b;
    const double lost = is_exact ? 0 : std::fabs(sum.hi) * kAddMulBound;
    return with_error(sum, (a_error + b_error + lost) * kRoundUp, exponent);
  }
  [[nodiscard]] double scaled_up(double size) const;

  DoubleDouble value_;
  double error_ = 0;
  std::int64_t exponent_ = 0;
};

inline Ball operator*(const Ball& a, const Ball& b) {
  if (a.is_exact_zero() || b.is_exact_zero()) return {};
  const bool is_exact = a.value_.lo == 0 && b.value_.lo == 0 && a.error_ == 0 && b.error_ == 0;
  const DoubleDouble product = is_exact ? two_product(a.value_.hi, b.value_.hi) : a.value_ * b.value_;
  const double a_size = std::fabs(a.value_.hi);
  const double b_size = std::fabs(b.value_.hi);
  const double lost = is_exact ? 0 : std::fabs(product.hi) * Ball::kAddMulBound;
  // hi stands for hi + lo here; kRoundUp covers |lo| <= 2^-53 |hi|.
  const double error = a_size * b.error_ + b_size * a.error_ + a.error_ * b.error_ + lost;
  return Ball::with_error(product, error * Ball::kRoundUp, a.exponent_ + b.exponent_);
}

/// A vector of balls: each component carries its error bound.
struct BallVec3 {
  Ball x, y, z;

  friend bool operator==(const BallVec3&, const BallVec3&) = default;
};

BallVec3 operator-(const BallVec3& a, const BallVec3& b);
BallVec3 operator*(const BallVec3& a, const Ball& factor);
Ball dot(const BallVec3& a, const BallVec3& b);
BallVec3 cross(const BallVec3& a, const BallVec3& b);
/// The unit vector in a's direction; `a` must not contain 0 and may have any finite length.
BallVec3 normalized(const BallVec3& a);
BallVec3 to_balls(const Vec3& v);

}  // namespace pipeline
