#include "libpipeline/numbers/angle.h"

#include <array>
#include <cmath>
#include <span>

namespace pipeline {
namespace {

// 1/1!, 1/3!, ... 1/27!, each with a relative error of at most 2^-107.
constexpr std::array<DoubleDouble, 14> kInverseOddFactorials = {{
    {0x1.0000000000000p+0, 0x0.0p+0},                  // 1/1!
    {0x1.5555555555555p-3, 0x1.5555555555555p-57},     // 1/3!
    {0x1.1111111111111p-7, 0x1.1111111111111p-63},     // 1/5!
    {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},    // 1/7!
    {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73},   // 1/9!
    {0x1.ae64567f544e4p-26, -0x1.c062e06d1f209p-80},   // 1/11!
    {0x1.6124613a86d09p-33, 0x1.f28e0cc748ebep-87},    // 1/13!
    {0x1.ae7f3e733b81fp-41, 0x1.1d8656b0ee8cbp-97},    // 1/15!
    {0x1.952c77030ad4ap-49, 0x1.ac981465ddc6cp-103},   // 1/17!
    {0x1.2f49b46814157p-57, 0x1.2650f61dbdcb4p-112},   // 1/19!
    {0x1.71b8ef6dcf572p-66, -0x1.d043ae40c4647p-120},  // 1/21!
    {0x1.761b41316381ap-75, -0x1.3423c7d91404fp-130},  // 1/23!
    {0x1.3f3ccdd165fa9p-84, -0x1.58ddadf344487p-139},  // 1/25!
    {0x1.d1ab1c2dccea3p-94, 0x1.054d0c78aea14p-149},   // 1/27!
}};

// 1/2!, 1/4!, ... 1/28!, each with a relative error of at most 2^-107.
constexpr std::array<DoubleDouble, 14> kInverseEvenFactorials = {{
    {0x1.0000000000000p-1, 0x0.0p+0},                  // 1/2!
    {0x1.5555555555555p-5, 0x1.5555555555555p-59},     // 1/4!
    {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},   // 1/6!
    {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76},    // 1/8!
    {0x1.27e4fb7789f5cp-22, 0x1.cbbc05b4fa99ap-76},    // 1/10!
    {0x1.1eed8eff8d898p-29, -0x1.2aec959e14c06p-83},   // 1/12!
    {0x1.93974a8c07c9dp-37, 0x1.05d6f8a2efd1fp-92},    // 1/14!
    {0x1.ae7f3e733b81fp-45, 0x1.1d8656b0ee8cbp-101},   // 1/16!
    {0x1.6827863b97d97p-53, 0x1.eec01221a8b0bp-107},   // 1/18!
    {0x1.e542ba4020225p-62, 0x1.ea72b4afe3c2fp-120},   // 1/20!
    {0x1.0ce396db7f853p-70, -0x1.aebcdbd20331cp-124},  // 1/22!
    {0x1.f2cf01972f578p-80, -0x1.9ada5fcc1ab14p-135},  // 1/24!
    {0x1.88e85fc6a4e5ap-89, -0x1.71c37ebd16540p-143},  // 1/26!
    {0x1.0a18a2635085dp-98, 0x1.b9e2e28e1aa54p-153},   // 1/28!
}};

// pi / 180, with a relative error of at most 2^-109.
constexpr DoubleDouble kRadiansPerDegree = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};

// A bound on the relative error of either series (tests/proofs/angle_series.g).
constexpr double kSeriesError = 0x1p-99;

/// c0 - c1 t + c2 t^2 - ... by Horner's rule.
DoubleDouble alternating_polynomial(std::span<const DoubleDouble> coefficients, DoubleDouble t) {
  DoubleDouble sum;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = coefficients[i] - sum * t;
  return sum;
}

Ball with_relative_error(DoubleDouble value) {
  return Ball::with_error(value, std::fabs(value.hi) * kSeriesError);
}

/// sine_cosine_of_degrees for an angle in [-45, 45] degrees.
SineCosine sine_cosine_of_reduced(DoubleDouble degrees) {
  if (degrees.hi == 0) return {0, 1, 0};
  if (std::fabs(degrees.hi) < kTinyDegrees) {
    // sin x = x and 1 - cos x = x^2 / 2, far beyond the precision of a ball.
    const Ball angle = to_radians(Ball(degrees.hi) + Ball(degrees.lo));
    const Ball tiny_versine = angle * angle * Ball(0.5);
    return {angle, Ball(1) - tiny_versine, tiny_versine};
  }
  const DoubleDouble x = degrees * kRadiansPerDegree;
  const DoubleDouble square = x * x;
  const bool is_thirty = std::fabs(degrees.hi) == 30 && degrees.lo == 0;
  const Ball sine = is_thirty
                        ? Ball(std::copysign(0.5, degrees.hi))
                        : with_relative_error(alternating_polynomial(kInverseOddFactorials, square) * x);
  const Ball versine = with_relative_error(alternating_polynomial(kInverseEvenFactorials, square) * square);
  return {sine, Ball(1) - versine, versine};
}

}  // namespace

Ball to_radians(const Ball& degrees) {
  return degrees * Ball::with_error(kRadiansPerDegree, 0x1p-114);
}

SineCosine sine_cosine_of_degrees(DoubleDouble degrees) {
  // fmod is exact, and so are the sums: both remainders lie on the grid of the larger part.
  const DoubleDouble turned = two_sum(std::fmod(degrees.hi, 360), std::fmod(degrees.lo, 360));
  const double quarter_turns = std::nearbyint(turned.hi / 90);
  const DoubleDouble reduced = two_sum(turned.hi - 90 * quarter_turns, turned.lo);
  const SineCosine r = sine_cosine_of_reduced(reduced);
  switch (static_cast<int>(quarter_turns) & 3) {
    case 0:
      return r;
    case 1:
      return {r.cosine, -r.sine, Ball(1) + r.sine};
    case 2:
      return {-r.sine, -r.cosine, Ball(1) + r.cosine};
    default:
      return {-r.cosine, r.sine, Ball(1) - r.sine};
  }
}

}  // namespace pipeline
