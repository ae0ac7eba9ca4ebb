#include "libpipeline/numbers/ball.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace pipeline {
namespace {

DoubleDouble scaled(DoubleDouble a, int exponent) {
  return {std::ldexp(a.hi, exponent), std::ldexp(a.lo, exponent)};
}

/// True if scaling a part of a ball by a power of two may have cut off bits near the subnormal range.
bool may_be_cut(double part, double moved_part) {
  return part != 0 && std::fabs(moved_part) < 0x1p-1000;
}

}  // namespace

Ball::Ball(double value) : value_{value, 0} {
  assert(std::isfinite(value));
  const double size = std::fabs(value);
  if (value != 0 && (size > kSafeMax || size < kSafeMin)) *this = with_error(value_, 0);
}

/// The general case; the larger of the midpoint and the error sets the exponent.
Ball Ball::normalized(DoubleDouble value, double error, std::int64_t exponent) {
  const double leading = std::max(std::fabs(value.hi), error);
  if (leading == 0) return {};
  if (exponent == 0 && leading <= kSafeMax && leading >= kSafeMin) return {value, error, 0};
  const int own = std::ilogb(leading);
  const std::int64_t whole = own + exponent;
  const bool safe = whole <= kSafeExponent && whole >= -kSafeExponent;
  const int shift = safe ? static_cast<int>(exponent) : -own;
  // Two steps, so that no intermediate number is subnormal: the result is near 2^whole or near 1.
  const int half = shift / 2;
  const DoubleDouble moved = scaled(scaled(value, half), shift - half);
  double moved_error = std::ldexp(std::ldexp(error, half), shift - half);
  if (may_be_cut(value.hi, moved.hi) || may_be_cut(value.lo, moved.lo) || may_be_cut(error, moved_error))
    moved_error = moved_error * kRoundUp + std::fabs(moved.hi) * 0x1p-150;
  return {moved, moved_error, safe ? 0 : exponent + own};
}

Ball operator-(const Ball& a) {
  return {-a.value_, a.error_, a.exponent_};
}

/// The general sum: scales the smaller operand to the exponent of the larger one.
Ball Ball::add_across_ranges(const Ball& a, const Ball& b) {
  const auto magnitude = [](const Ball& ball) {
    return std::ilogb(std::fabs(ball.value_.hi) + ball.error_) + ball.exponent_;
  };
  const std::int64_t a_magnitude = magnitude(a);
  const std::int64_t b_magnitude = magnitude(b);
  const bool a_is_larger = a_magnitude >= b_magnitude;
  const Ball& large = a_is_larger ? a : b;
  const Ball& small = a_is_larger ? b : a;
  const int large_shift = -std::ilogb(std::fabs(large.value_.hi) + large.error_);
  const DoubleDouble large_value = scaled(large.value_, large_shift);
  // Far below the last bit of the midpoint, and more than scaling can cut off.
  constexpr double kCut = 0x1p-500;
  double large_error = std::ldexp(large.error_, large_shift);
  if (may_be_cut(large.value_.lo, large_value.lo)) large_error += kCut;
  const std::int64_t common = large.exponent_ - large_shift;
  const std::int64_t small_shift = small.exponent_ - common;
  // An operand more than 600 binary places smaller only adds to the error.
  if (std::abs(a_magnitude - b_magnitude) > 600)
    return with_error(large_value, (large_error + kCut) * kRoundUp, common);
  const DoubleDouble small_value = scaled(small.value_, static_cast<int>(small_shift));
  double small_error = std::ldexp(small.error_, static_cast<int>(small_shift));
  if (may_be_cut(small.value_.lo, small_value.lo) || may_be_cut(small.error_, small_error))
    small_error += kCut;
  return add_parts(large_value, large_error, small_value, small_error, common);
}

Ball operator/(const Ball& a, const Ball& b) {
  assert(b.sign() != 0);
  if (a.is_exact_zero()) return {};
  const DoubleDouble quotient = a.value_ / b.value_;
  const double a_size = std::fabs(a.value_.hi) * Ball::kRoundUp;
  const double b_size = std::fabs(b.value_.hi) / Ball::kRoundUp;
  // (a +- ea)/(b +- eb) - a/b is at most (ea + |a/b| eb) / (|b| - eb).
  const double spread = (a.error_ + a_size / b_size * b.error_) / (b_size - b.error_);
  const bool plain = a.is_exact() && b.is_exact() && a.value_.lo == 0 && b.value_.lo == 0;
  const bool divides = plain && quotient.lo == 0 && std::fma(quotient.hi, b.value_.hi, -a.value_.hi) == 0;
  const double lost = divides ? 0 : std::fabs(quotient.hi) * Ball::kDivSqrtBound;
  return Ball::with_error(quotient, (spread + lost) * Ball::kRoundUp, a.exponent_ - b.exponent_);
}

Ball sqrt(const Ball& a) {
  if (a.is_exact_zero()) return {};
  const bool odd = a.exponent_ % 2 != 0;
  const DoubleDouble value = odd ? scaled(a.value_, 1) : a.value_;
  const double error = odd ? 2 * a.error_ : a.error_;
  const std::int64_t exponent = (a.exponent_ - (odd ? 1 : 0)) / 2;
  if (value.hi <= error) return Ball::with_error({0, 0}, std::sqrt(2 * error) * Ball::kRoundUp, exponent);
  const DoubleDouble root = sqrt(value);
  const DoubleDouble square = two_product(root.hi, root.hi);
  const bool perfect = error == 0 && root.lo == 0 && square.hi == value.hi && square.lo == value.lo;
  // |sqrt(v +- e) - sqrt(v)| <= e / sqrt(v).
  const double lost = perfect ? 0 : root.hi * Ball::kDivSqrtBound + error / root.hi * Ball::kRoundUp;
  return Ball::with_error(root, lost * Ball::kRoundUp, exponent);
}

Ball Ball::with_error_at_most(double bound) const {
  if (error_ == 0) return *this;
  const auto shift = static_cast<int>(std::clamp<std::int64_t>(-exponent_, -3000, 3000));
  // `least` keeps the error above 0 even if the bound underflows: the ball is not exact.
  const double least = std::max(std::fabs(value_.hi), error_) * 0x1p-150;
  const double limit = (exponent_ == 0 ? bound : std::ldexp(bound, shift)) + least;
  return limit < error_ ? with_error(value_, limit, exponent_) : *this;
}

/// An upper bound on size * 2^exponent; above 0 for a size above 0.
double Ball::scaled_up(double size) const {
  if (exponent_ == 0) return size * kRoundUp;
  const auto shift = static_cast<int>(std::clamp<std::int64_t>(exponent_, -3000, 3000));
  return std::ldexp(size, shift) * kRoundUp + 0x1p-1000;
}

int Ball::sign() const {
  // Rounded up twice, so that the lower end of a divisor stays above 0 after one rounding down.
  if (std::fabs(value_.hi) <= error_ * (kRoundUp * kRoundUp)) return 0;
  return value_.hi > 0 ? 1 : -1;
}

double Ball::nearest_double() const {
  if (exponent_ == 0) return value_.hi;
  // Beyond +-3000 every double but 0 over- or underflows.
  const auto shift = static_cast<int>(std::clamp<std::int64_t>(exponent_, -3000, 3000));
  const double nearest = std::ldexp(value_.hi, shift);
  if (!std::isfinite(nearest)) return nearest;
  // Below the normal range ldexp has rounded hi alone; on a tie of hi the low part decides.
  const double back = std::ldexp(nearest, -shift);
  const double rest = value_.hi - back;
  const double neighbor = std::nextafter(nearest, std::copysign(HUGE_VAL, rest));
  const bool is_tie = rest != 0 && 2 * rest == std::ldexp(neighbor, -shift) - back;
  const bool is_beyond_tie = value_.lo != 0 && std::signbit(value_.lo) == std::signbit(rest);
  return is_tie && is_beyond_tie ? neighbor : nearest;
}

BallVec3 operator-(const BallVec3& a, const BallVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
BallVec3 operator*(const BallVec3& a, const Ball& factor) {
  return {a.x * factor, a.y * factor, a.z * factor};
}
Ball dot(const BallVec3& a, const BallVec3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

BallVec3 cross(const BallVec3& a, const BallVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

BallVec3 normalized(const BallVec3& a) {
  const Ball length = sqrt(dot(a, a));
  return {a.x / length, a.y / length, a.z / length};
}

BallVec3 to_balls(const Vec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace pipeline
