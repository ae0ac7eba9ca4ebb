
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "libpipeline/text/number_printer.h"
#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"

namespace pipeline {
namespace {

// Holds the sum of any two doubles.
using Exact = Real<2304>;

std::string printed(DoubleDouble value, int decimals) {
  char text[kMaxNumberLength];
  return {text, print_exact_sum(text, value.hi, value.lo, decimals)};
}

/// By either way: print_number takes a shorter one where 62 bits hold the units of the last decimal.
void expect_exact(DoubleDouble value, int decimals) {
  const std::string exact = Exact(value).text(decimals);
  char text[kMaxNumberLength];
  const std::string number = {text, print_number(text, value.hi, value.lo, {decimals})};
  ASSERT_TRUE(printed(value, decimals) == exact && number == exact)
      << exact << " is printed " << printed(value, decimals) << " and " << number << ": " << std::hexfloat
      << value.hi << " + " << value.lo << ", " << decimals << " decimals";
}

TEST(WideDecimal, PrintsAnySumExactly) {
  RandomNumbers random(1);
  for (int i = 0; i < 60'000; ++i)
    expect_exact(random.double_double(-80, 300), random.whole(0, kMaxDecimals));
}

TEST(WideDecimal, PrintsSumsOfAnyTwoDoubles) {
  RandomNumbers random(2);
  for (int i = 0; i < 5'000; ++i) {
    const DoubleDouble sum = two_sum(random.any_double() / 2, random.any_double() / 2);
    if (std::isfinite(sum.lo)) expect_exact(sum, random.whole(0, kMaxDecimals));
  }
}

TEST(WideDecimal, PrintsSumsOfAbout62BitsExactly) {
  RandomNumbers random(5);
  for (int i = 0; i < 60'000; ++i) {
    const int decimals = random.whole(0, kMaxDecimals);
    const int bits = random.whole(48, 66) - static_cast<int>(decimals * std::log2(10.0));
    const DoubleDouble value = random.double_double(bits, bits + 1);
    expect_exact(value, decimals);
    expect_exact({value.hi, 0}, decimals);
  }
}

TEST(WideDecimal, PrintsSubnormalNumbers) {
  expect_exact({0x1p-1074, 0}, kMaxDecimals);
  expect_exact({1, 0x1p-1074}, kMaxDecimals);
  expect_exact({1, -0x1p-1074}, kMaxDecimals);
}

TEST(WideDecimal, PrintsZero) {
  EXPECT_EQ(printed({0, 0}, 0), "0");
  EXPECT_EQ(printed({0, 0}, 7), "0.0000000");
}

TEST(WideDecimal, TiesAreRoundedToEven) {
  EXPECT_EQ(printed({0x1p60, 0.5}, 0), "1152921504606846976");
  EXPECT_EQ(printed({0x1p60, 1.5}, 0), "1152921504606846978");
  EXPECT_EQ(printed({0x1p60, -0.5}, 0), "1152921504606846976");
  EXPECT_EQ(printed({-0x1p60, -1.5}, 0), "-1152921504606846978");
}

TEST(WideDecimal, TheLeastBitBesideATieDecides) {
  RandomNumbers random(3);
  for (int i = 0; i < 20'000; ++i) {
    const int decimals = random.whole(0, kMaxDecimals);
    const double tie = std::ldexp(2.0 * random.whole(0, 1 << 30) + 1, -decimals - 1);
    const double beside = std::ldexp(random.whole(-1, 1), random.whole(-1074, -90));
    expect_exact({tie, beside}, decimals);
    expect_exact({-tie, beside}, decimals);
  }
}

TEST(WideDecimal, LongPrintsAMillionSumsOfAnySizeExactly) {
  RandomNumbers random(4);
  for (int i = 0; i < 1'000'000; ++i)
    expect_exact(random.double_double(-900, 1000), random.whole(0, kMaxDecimals));
}

TEST(WideDecimal, PrintsTheSumOfTheLargestNumbers) {
  constexpr double kMaxDouble = std::numeric_limits<double>::max();
  expect_exact({kMaxDouble, 0}, kMaxDecimals);
  expect_exact({kMaxDouble, -0x1p-1074}, kMaxDecimals);
  expect_exact({kMaxDouble, 0x1p-1074}, 0);
  expect_exact({-kMaxDouble, -0x1p969}, 1);
}

TEST(WideDecimal, CarriesIntoANewFirstDigit) {
  EXPECT_EQ(printed({999, 0x1p-1}, 0), "1000");
  EXPECT_EQ(printed({9, 1}, 0), "10");
  EXPECT_EQ(printed({9, 0x1.fffffffffffffp-1}, 7), "10.0000000");
  EXPECT_EQ(printed({-9, -9}, 2), "-18.00");
}

TEST(WideDecimal, CarriesThroughAllDigits) {
  EXPECT_EQ(printed({1e22, -0x1p-30}, 7), "10000000000000000000000.0000000");
  EXPECT_EQ(printed({1e22, -0.25}, 1), "9999999999999999999999.8");
}

}  // namespace
}  // namespace pipeline
