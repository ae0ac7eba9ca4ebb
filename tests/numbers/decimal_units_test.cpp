// The rounding test against exact arithmetic.

#include "libpipeline/numbers/decimal_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/numbers/random_numbers.h"
#include "tests/numbers/random_tie.h"
#include "tests/numbers/real.h"

namespace pipeline {
namespace {

/// True if every number within `error` of `value` is certain to have the text of `value`.
bool rounds_safely(double value, double error, int decimals) {
  const double scale = kPowersOfTen[static_cast<std::size_t>(decimals)];
  return DecimalUnits(value, scale).is_certain(error * scale);
}

/// Checks values a few units in the last place around a tie, with errors that just reach it or just do not.
void expect_never_wrongly_safe(std::uint64_t seed, int count) {
  RandomNumbers random(seed);
  int safe_count = 0;
  for (int i = 0; i < count; ++i) {
    const Tie tie = random_tie(random, i % 4 == 0 ? 2 : 0x1p51);
    double value = tie.value.nearest_double();
    const double step = std::ldexp(tie.unit.nearest_double(), random.whole(-60, -2));
    value += step * random.between(-1, 1);
    double error = std::fabs((tie.value - Exact(value)).nearest_double());
    for (int ulps = random.whole(-3, 3); ulps != 0; ulps += ulps < 0 ? 1 : -1)
      error = std::nextafter(error, ulps < 0 ? 0 : HUGE_VAL);
    if (i % 8 == 7) error = std::fabs(error) * random.between(0, 1.01);
    if (!rounds_safely(value, error, tie.decimals)) continue;
    ++safe_count;
    const std::string text = Exact(value).text(tie.decimals);
    for (const double sign : {-1, 1})
      ASSERT_EQ((Exact(value) + Exact(sign * error)).text(tie.decimals), text)
          << std::hexfloat << value << " +- " << error << ", " << tie.decimals << " decimals";
  }
  EXPECT_GT(safe_count, count / 100);
}

TEST(NearestWhole, TiesAreRoundedToEven) {
  EXPECT_EQ(nearest_whole(0.5), 0);
  EXPECT_EQ(nearest_whole(1.5), 2);
  EXPECT_EQ(nearest_whole(-2.5), -2);
  EXPECT_EQ(nearest_whole(0x1p51 - 0.5), 0x1p51);
  EXPECT_EQ(nearest_whole(-0x1p51 + 1.5), -0x1p51 + 2);
}

TEST(NearestWhole, IsTheWholeNumberOfTheCLibrary) {
  RandomNumbers random(10);
  for (int i = 0; i < 100'000; ++i) {
    const double value = random.with_exponent(-4, 50);
    ASSERT_EQ(nearest_whole(value), std::nearbyint(value)) << std::hexfloat << value;
  }
}

TEST(DecimalUnits, AreNotCertainFrom2To51UnitsOn) {
  EXPECT_TRUE(rounds_safely(0x1p50, 0, 0));
  for (const double value : {0x1p51, 0x1p52, 0x1p53, 1e300})
    EXPECT_FALSE(rounds_safely(value, 0, 0)) << value;
}

TEST(DecimalUnits, AreNeverCertainOfANumberWhoseErrorReachesATie) {
  expect_never_wrongly_safe(8, 40'000);
}
TEST(DecimalUnits, LongAreNeverCertainOfANumberWhoseErrorReachesATie) {
  expect_never_wrongly_safe(108, 1'000'000);
}

TEST(DecimalUnits, AreCertainOfMostNumbersOfDoubleAccuracy) {
  RandomNumbers random(9);
  int safe_count = 0;
  for (int i = 0; i < 10'000; ++i) {
    const double value = random.between(-100, 100);
    if (rounds_safely(value, 8 * 0x1p-53 * std::fabs(value), 7)) ++safe_count;
  }
  EXPECT_GT(safe_count, 9'990);
}

TEST(DecimalUnits, AreCertainOfANumberFarFromATie) {
  EXPECT_TRUE(rounds_safely(0.12345670, 1e-12, 7));
}

TEST(DecimalUnits, AreNotCertainOfANumberWithinItsErrorOfATie) {
  EXPECT_FALSE(rounds_safely(0.12345675, 1e-16, 7));
  EXPECT_FALSE(rounds_safely(0.5, 0, 0));
}

TEST(DecimalUnits, AreNotCertainOfInfinitiesAndNan) {
  EXPECT_FALSE(rounds_safely(HUGE_VAL, 0, 7));
  EXPECT_FALSE(rounds_safely(-HUGE_VAL, 0, 7));
  EXPECT_FALSE(rounds_safely(NAN, 0, 7));
  EXPECT_FALSE(rounds_safely(1, HUGE_VAL, 7));
  EXPECT_FALSE(rounds_safely(1, NAN, 7));
}

}  // namespace
}  // namespace pipeline
