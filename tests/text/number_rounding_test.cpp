// round_to_text against exact arithmetic.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/number_rounding.h"
#include "tests/numbers/random_numbers.h"
#include "tests/numbers/random_tie.h"
#include "tests/numbers/real.h"

namespace pipeline {
namespace {

DoubleDouble to_double_double(const Exact& value) {
  const double hi = value.nearest_double();
  return {hi, (value - Exact(hi)).nearest_double()};
}

std::string text_of(const PrintableNumber& number, NumberFormat format) {
  char text[kMaxNumberLength];
  return {text, print_number(text, number.hi, number.lo, format)};
}

TEST(RoundToText, ATieWithinTheErrorCountsAsTheTie) {
  RandomNumbers random(1);
  for (int i = 0; i < 8'000; ++i) {
    const Tie tie = random_tie(random, 0x1p60);
    const Exact error = tie.unit * Exact(std::ldexp(1.0, random.whole(-35, -21)));
    const Exact middle = tie.value + error * Exact(random.between(-0.9, 0.9));
    const Ball ball = Ball::with_error(to_double_double(middle), error.nearest_double());
    const PrintableNumber rounded = round_to_text(ball, {tie.decimals});
    ASSERT_EQ(text_of(rounded, {tie.decimals}), tie.text) << "near " << tie.value;
    ASSERT_TRUE(rounded.is_certain);
  }
}

TEST(RoundToText, ATieIsCertainOnlyIfTheWholeBallIsWithinTwoToTheMinus20) {
  const double unit = 1e-7;
  const double tie = 0.5 * unit;
  const auto is_certain = [&](double distance, double error) {
    return round_to_text(Ball::with_error(two_sum(tie, distance * 0x1p-20 * unit), error * 0x1p-20 * unit),
                         {7})
        .is_certain;
  };
  EXPECT_TRUE(is_certain(0.45, 0.5));
  EXPECT_FALSE(is_certain(0.6, 0.7));
  EXPECT_FALSE(is_certain(-0.6, 0.7));
}

TEST(RoundToText, ATieOutsideTheErrorDecidesNothing) {
  RandomNumbers random(2);
  for (int i = 0; i < 8'000; ++i) {
    const Tie tie = random_tie(random, 0x1p40);
    const Exact error = tie.unit * Exact(std::ldexp(1.0, random.whole(-50, -3)));
    const Exact middle = tie.value + error * Exact(random.bits() % 2 == 0 ? 1.01 : -1.01);
    const Ball ball = Ball::with_error(to_double_double(middle), error.nearest_double());
    const PrintableNumber rounded = round_to_text(ball, {tie.decimals});
    ASSERT_EQ(text_of(rounded, {tie.decimals}), middle.text(tie.decimals)) << "near " << tie.value;
    ASSERT_TRUE(rounded.is_certain);
  }
}

TEST(RoundToText, ANumberCloseToATieIsNotTakenForItIfItsErrorIsSmaller) {
  // 0.00390625 + 1e-25 is known within 1e-30 here, although no double distinguishes it from the tie.
  const Ball ball = Ball::with_error({0.00390625, 1e-25}, 1e-30);
  EXPECT_EQ(text_of(round_to_text(ball, {7}), {7}), "0.0039063");
}

TEST(RoundToText, ABallThatIsTooWideIsNotCertain) {
  RandomNumbers random(3);
  for (int i = 0; i < 8'000; ++i) {
    const Tie tie = random_tie(random, 0x1p60);
    const Exact error = tie.unit * Exact(random.between(0x1p-18, 3));
    const Exact middle = tie.value + error * Exact(random.between(-0.99, 0.99));
    const Ball ball = Ball::with_error(to_double_double(middle), error.nearest_double());
    ASSERT_FALSE(round_to_text(ball, {tie.decimals}).is_certain) << "near " << tie.value;
  }
}

TEST(RoundToText, ACertainTextIsThatOfEveryNumberInTheBall) {
  RandomNumbers random(4);
  for (int i = 0; i < 10'000; ++i) {
    const DoubleDouble value = random.double_double(-60, 160);
    const int decimals = random.whole(0, kMaxDecimals);
    const double error = std::ldexp(std::fabs(value.hi), random.whole(-106, -40));
    const PrintableNumber rounded = round_to_text(Ball::with_error(value, error), {decimals});
    if (!rounded.is_certain) continue;
    const std::string lower = (Exact(value) - Exact(error)).text(decimals);
    const std::string upper = (Exact(value) + Exact(error)).text(decimals);
    const bool is_tie = lower != upper && error * std::pow(10, decimals) <= 0x1p-20;
    ASSERT_TRUE(is_tie || text_of(rounded, {decimals}) == lower)
        << std::hexfloat << value.hi << " + " << value.lo << " +- " << error;
    ASSERT_TRUE(is_tie || text_of(rounded, {decimals}) == upper)
        << std::hexfloat << value.hi << " + " << value.lo << " +- " << error;
  }
}

TEST(RoundToText, AnExactNumberIsAlwaysCertain) {
  RandomNumbers random(5);
  for (int i = 0; i < 10'000; ++i) {
    const int decimals = random.whole(0, kMaxDecimals);
    const double value = random.any_double();
    const PrintableNumber rounded = round_to_text(Ball(value), {decimals});
    ASSERT_TRUE(rounded.is_certain);
    ASSERT_EQ(text_of(rounded, {decimals}), Exact(value).text(decimals)) << std::hexfloat << value;
  }
}

TEST(RoundToText, AnExactSumKeepsTheDigitsOfItsLowPart) {
  const Ball sum = Ball(1e16) + Ball(0.1);
  EXPECT_EQ(text_of(round_to_text(sum, {7}), {7}), "10000000000000000.1000000");
}

TEST(RoundToText, KnowsTheFirstDecimalsOfLargeNumbers) {
  // 2^101 units of the seventh decimal, known to a quarter of one.
  const double whole = 0x1p101;
  const Exact truth = Exact(whole + 0x1p49) / Exact(1e7);
  const DoubleDouble value = to_double_double(truth);
  const Ball ball = Ball::with_error(value, 0.2e-7);
  const PrintableNumber rounded = round_to_text(ball, {7});
  EXPECT_EQ(text_of(rounded, {7}), Exact(value).text(7));
}

TEST(RoundToText, ABallAroundZeroIsZero) {
  EXPECT_EQ(text_of(round_to_text(Ball::with_error({1e-32, 0}, 2e-32), {7}), {7}), "0.0000000");
  EXPECT_EQ(text_of(round_to_text(Ball::with_error({-1e-32, 0}, 2e-32), {7}), {7}), "0.0000000");
  EXPECT_EQ(
      text_of(round_to_text(Ball::with_error({1e-32, 0}, 2e-32), {.shortest = true}), {.shortest = true}),
      "0");
}

TEST(RoundToText, ABallAroundZeroIsCertainBesideTwoToThe60TimesItsSize) {
  for (const double size : {1e-30, 1.0, 1e32}) {
    const auto around_zero = [&](double error) {
      return round_to_text(Ball::with_error({0, 0}, error * 0x1p-60 * size), {.shortest = true}, size);
    };
    EXPECT_TRUE(around_zero(0.99).is_certain) << size;
    EXPECT_FALSE(around_zero(1.01).is_certain) << size;
    EXPECT_EQ(around_zero(1.01).hi, 0) << size;
  }
}

TEST(RoundToText, OverflowIsInfinite) {
  EXPECT_EQ(round_to_text(Ball(1e300) * Ball(1e300), {7}).hi, HUGE_VAL);
  EXPECT_EQ(round_to_text(Ball(-1e300) * Ball(1e300), {.shortest = true}).hi, -HUGE_VAL);
}

TEST(RoundToText, WhatIsFarBelowTheLastDecimalIsZero) {
  EXPECT_EQ(text_of(round_to_text(Ball(-1e-300) * Ball(1e-300), {17}), {17}), "0.00000000000000000");
}

TEST(RoundToText, ANumberOfWhichNothingIsKnownIsNotCertain) {
  EXPECT_FALSE(round_to_text(Ball::with_error({0, 0}, 1e10), {7}).is_certain);
  EXPECT_FALSE(round_to_text(Ball::with_error({1, 0}, 1e10) * Ball(1e300), {7}).is_certain);
}

TEST(RoundToShortest, GivesTheNearestDoubleOfEveryNumberInTheBall) {
  RandomNumbers random(6);
  for (int i = 0; i < 50'000; ++i) {
    const DoubleDouble value = random.double_double(-250, 250);
    const double error = std::ldexp(std::fabs(value.hi), random.whole(-106, -54));
    const PrintableNumber rounded = round_to_text(Ball::with_error(value, error), {.shortest = true});
    const double lower = (Exact(value) - Exact(error)).nearest_double();
    const double upper = (Exact(value) + Exact(error)).nearest_double();
    const bool is_tie = lower != upper && error <= std::fabs(value.hi) * 0x1p-71;
    ASSERT_TRUE(lower != upper || rounded.hi == lower) << std::hexfloat << value.hi << " + " << value.lo;
    ASSERT_TRUE(lower == upper || is_tie || !rounded.is_certain)
        << std::hexfloat << value.hi << " + " << value.lo << " +- " << error;
  }
}

TEST(RoundToShortest, ATieWithinTheErrorCountsAsTheTie) {
  RandomNumbers random(7);
  for (int i = 0; i < 50'000; ++i) {
    const double below = random.with_exponent(-250, 250);
    const double above = std::nextafter(below, HUGE_VAL);
    const Exact tie = (Exact(below) + Exact(above)) * Exact(0.5);
    const double error = std::ldexp(std::fabs(below), random.whole(-98, -76));
    const Exact middle = tie + Exact(error) * Exact(random.between(-0.9, 0.9));
    const PrintableNumber rounded =
        round_to_text(Ball::with_error(to_double_double(middle), error), {.shortest = true});
    ASSERT_EQ(rounded.hi, tie.nearest_double()) << std::hexfloat << below << " +- " << error;
    ASSERT_TRUE(rounded.is_certain) << std::hexfloat << below << " +- " << error;
  }
}

TEST(RoundToShortest, ATieIsCertainOnlyIfTheWholeBallIsWithinTwoToTheMinus20) {
  const auto is_certain = [](double distance, double error) {
    return round_to_text(Ball::with_error({1, 0x1p-53 + distance * 0x1p-72}, error * 0x1p-72), kShortest)
        .is_certain;
  };
  EXPECT_TRUE(is_certain(-0.45, 0.5));
  EXPECT_FALSE(is_certain(-0.6, 0.7));
}

TEST(RoundToShortest, ATieBetweenSubnormalNumbersCountsAsTheTie) {
  // 2.5 and 3.5 times the smallest double, which is known within 2^-90 of itself.
  const Ball unit = Ball(0x1p-1074) * Ball::with_error({1, 0}, 0x1p-90);
  EXPECT_EQ(round_to_text(unit * Ball(2.5), {.shortest = true}).hi, 2 * 0x1p-1074);
  EXPECT_EQ(round_to_text(unit * Ball(3.5), {.shortest = true}).hi, 4 * 0x1p-1074);
}

TEST(RoundToShortest, ANumberBesideATieOfSubnormalNumbersIsTheNearest) {
  const Ball unit = Ball(0x1p-1074) * Ball::with_error({1, 0}, 0x1p-90);
  const Ball beside = Ball(0x1p-80);
  EXPECT_EQ(round_to_text(unit * (Ball(2.5) + beside), {.shortest = true}).hi, 3 * 0x1p-1074);
  EXPECT_EQ(round_to_text(unit * (Ball(3.5) - beside), {.shortest = true}).hi, 3 * 0x1p-1074);
}

}  // namespace
}  // namespace pipeline
