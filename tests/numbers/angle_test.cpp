#include "libpipeline/numbers/angle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"
#include "tests/numbers/worst_error.h"

namespace pipeline {
namespace {

using Exact512 = Real<512>;
// Holds the exact angle, however far apart its two parts are.
using ExactAngle = Real<2304>;

/// An angle in radians, after whole turns are removed in degrees.
Exact512 radians(DoubleDouble degrees) {
  const ExactAngle reduced = remainder(ExactAngle(degrees), ExactAngle(360));
  return Exact512::nearest(reduced * ExactAngle::pi() / ExactAngle(180));
}

void expect_contained(DoubleDouble degrees) {
  const Exact512 x = radians(degrees);
  const Exact512 half_sine = sin(times_power_of_two(x, -1));
  // The effect of the rounding of x on the functions.
  const Exact512 slack = abs(times_power_of_two(x, -500));
  const SineCosine computed = sine_cosine_of_degrees(degrees);
  ASSERT_TRUE(contains(computed.sine, sin(x), slack));
  ASSERT_TRUE(contains(computed.cosine, cos(x), slack * abs(x)));
  ASSERT_TRUE(contains(computed.versine, times_power_of_two(half_sine * half_sine, 1), slack * abs(x)));
}

/// The error bounds must be not only true but also small: 2^-98 of the result.
void expect_narrow(const Ball& ball) {
  ASSERT_LE(ball.error(), std::fabs(ball.value().hi) * 0x1p-97) << std::hexfloat << ball.value().hi;
}

template <typename Angle>
void expect_all_contained(Angle angle, std::uint64_t seed, int count) {
  RandomNumbers random(seed);
  for (int i = 0; i < count; ++i) {
    const DoubleDouble degrees = angle(random);
    expect_contained(degrees);
    const SineCosine computed = sine_cosine_of_degrees(degrees);
    expect_narrow(computed.sine);
    expect_narrow(computed.cosine);
    expect_narrow(computed.versine);
    if (testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << std::hexfloat << degrees.hi << " + " << degrees.lo;
      return;
    }
  }
}

DoubleDouble in_a_turn(RandomNumbers& random) {
  return {random.between(-720, 720), 0};
}
DoubleDouble of_any_size(RandomNumbers& random) {
  return {random.any_double(), 0};
}
DoubleDouble long_in_a_turn(RandomNumbers& random) {
  return two_product(random.between(0.1, 180), random.between(0.1, 2));
}
DoubleDouble tiny(RandomNumbers& random) {
  return random.double_double(-900, -150);
}
DoubleDouble huge(RandomNumbers& random) {
  return {random.with_exponent(60, 1023), 0};
}
DoubleDouble long_and_huge(RandomNumbers& random) {
  return random.double_double(40, 120);
}
/// Within 2^-40 to 2^-140 of a multiple of 15 degrees.
DoubleDouble near_to_special(RandomNumbers& random) {
  const double special = 15.0 * random.whole(-48, 48);
  if (special == 0) return {random.with_exponent(-140, -40), 0};
  return two_sum(special, random.with_exponent(-140, -40));
}

TEST(Angle, ContainsTheTruth) {
  for (const auto angle :
       {in_a_turn, of_any_size, long_in_a_turn, tiny, huge, long_and_huge, near_to_special})
    expect_all_contained(angle, 1, 5'000);
}

TEST(Angle, SeriesAreWithin2ToMinus99) {
  RandomNumbers random(8);
  WorstError worst("angle series, parts of sine and 1 - cosine");
  for (int i = 0; i < 20'000; ++i) {
    const DoubleDouble degrees =
        i % 2 == 0 ? random.double_double(-40, 4) : two_sum(random.between(-45, 45), 0x1p-50);
    const Exact512 x = radians(degrees), half_sine = sin(times_power_of_two(x, -1));
    const Exact512 versine = times_power_of_two(half_sine * half_sine, 1);
    const SineCosine computed = sine_cosine_of_degrees(degrees);
    const Exact512 sine_error = abs(midpoint<512>(computed.sine) - sin(x)) / abs(sin(x));
    const Exact512 versine_error = abs(midpoint<512>(computed.versine) - versine) / versine;
    ASSERT_LE(sine_error, Exact512(0x1p-99)) << std::hexfloat << degrees.hi;
    ASSERT_LE(versine_error, Exact512(0x1p-99)) << std::hexfloat << degrees.hi;
    worst.add(std::max(sine_error.nearest_double(), versine_error.nearest_double()));
  }
}

TEST(Angle, LongContainsTheTruth) {
  expect_all_contained(in_a_turn, 101, 200'000);
  expect_all_contained(of_any_size, 102, 100'000);
  expect_all_contained(long_in_a_turn, 103, 200'000);
  expect_all_contained(tiny, 104, 100'000);
  expect_all_contained(huge, 105, 100'000);
  expect_all_contained(long_and_huge, 106, 100'000);
  expect_all_contained(near_to_special, 107, 200'000);
}

/// 0, +-1/2 or +-1 for a multiple of 30 degrees; nullopt if the sine is not rational.
struct RationalSine {
  int thirties;
  double sine;
};
constexpr RationalSine kRationalSines[] = {{0, 0}, {1, 0.5},  {3, 1},  {5, 0.5},
                                           {6, 0}, {7, -0.5}, {9, -1}, {11, -0.5}};

TEST(Angle, RationalSinesAreExact) {
  for (const auto& [thirties, sine] : kRationalSines) {
    for (int turns = -1000; turns <= 1000; ++turns) {
      const double degrees = 30.0 * thirties + 360.0 * turns;
      const Ball computed = sine_cosine_of_degrees({degrees, 0}).sine;
      ASSERT_EQ(computed, Ball(sine)) << degrees;
    }
  }
}

TEST(Angle, RationalCosinesAreExact) {
  for (const auto& [thirties, cosine] : kRationalSines) {
    for (int turns = -1000; turns <= 1000; ++turns) {
      const double degrees = 90 - 30.0 * thirties + 360.0 * turns;
      const SineCosine computed = sine_cosine_of_degrees({degrees, 0});
      ASSERT_EQ(computed.cosine, Ball(cosine)) << degrees;
      ASSERT_EQ(computed.versine, Ball(1 - cosine)) << degrees;
    }
  }
}

TEST(Angle, RightAnglesOfHugeSizeAreExact) {
  // 90 * 2^80 degrees are whole turns, 2^70 * 30 degrees exceed whole turns by 240 (2^70 = 16 mod 24).
  EXPECT_EQ(sine_cosine_of_degrees({90 * 0x1p80, 0}).cosine, Ball(1));
  EXPECT_EQ(sine_cosine_of_degrees({90 * 0x1p80, 0}).sine, Ball());
  EXPECT_EQ(sine_cosine_of_degrees({30 * 0x1p70, 0}).cosine, Ball(-0.5));
}

TEST(Angle, FortyFiveDegreesAreTheRootOfAHalf) {
  const SineCosine computed = sine_cosine_of_degrees({45, 0});
  EXPECT_TRUE(contains(computed.sine, sqrt(Exact512(0.5))));
  EXPECT_TRUE(contains(computed.cosine, sqrt(Exact512(0.5))));
}

TEST(Angle, SixtyDegreesHaveTheRootOfThreeQuartersAsSine) {
  EXPECT_TRUE(contains(sine_cosine_of_degrees({60, 0}).sine, sqrt(Exact512(0.75))));
}

TEST(Angle, TenToTheTwentyTwoDegreesAreReducedExactly) {
  // 1e22 is exact in a double; 1e22 mod 360 = 280.
  const SineCosine computed = sine_cosine_of_degrees({1e22, 0});
  EXPECT_EQ(computed.sine, sine_cosine_of_degrees({280, 0}).sine);
  EXPECT_EQ(computed.cosine, sine_cosine_of_degrees({280, 0}).cosine);
}

TEST(Angle, OfTheSmallestDoubleIsKnown) {
  const double smallest = 0x1p-1074;
  const SineCosine computed = sine_cosine_of_degrees({smallest, 0});
  EXPECT_EQ(computed.sine.sign(), 1);
  EXPECT_EQ(computed.versine.sign(), 1);
  EXPECT_EQ(computed.cosine.nearest_double(), 1);
}

TEST(Angle, ZeroIsExact) {
  const SineCosine computed = sine_cosine_of_degrees({0, 0});
  EXPECT_TRUE(computed.sine.is_exact_zero());
  EXPECT_EQ(computed.cosine, Ball(1));
  EXPECT_TRUE(computed.versine.is_exact_zero());
}

}  // namespace
}  // namespace pipeline
