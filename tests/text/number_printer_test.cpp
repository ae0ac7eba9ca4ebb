#include "libpipeline/text/number_printer.h"

#include <gtest/gtest.h>

#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "tests/numbers/random_numbers.h"
#include "tests/text/comma_locale.h"

namespace pipeline {
namespace {

constexpr double kLargestDouble = std::numeric_limits<double>::max();

std::string printed(double hi, double lo, NumberFormat format) {
  char text[kMaxNumberLength];
  return {text, print_number(text, hi, lo, format)};
}

/// The C library's text, which is exact, without the sign of a zero.
std::string printed_by_c(double value, int decimals) {
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string result = text;
  const bool is_zero = result.find_first_of("123456789") == std::string::npos;
  return is_zero && result.front() == '-' ? result.substr(1) : result;
}

TEST(PrintNumber, AgreesWithTheCLibraryForAnyDoubleAndAnyDecimals) {
  RandomNumbers random(2);
  for (int i = 0; i < 100'000; ++i) {
    const double value = i % 2 == 0 ? random.any_double() : random.with_exponent(-70, 70);
    const int decimals = random.whole(0, kMaxDecimals);
    ASSERT_EQ(printed(value, 0, {decimals}), printed_by_c(value, decimals)) << std::hexfloat << value;
  }
}

// Numbers of the magnitude of coordinates, many of them with few digits: near and on ties.
TEST(PrintNumberLong, AgreesWithToCharsForEveryCountOfDecimals) {
  RandomNumbers random(5);
  char expected[kMaxNumberLength];
  for (int i = 0; i < 100'000'000; ++i) {
    const int decimals = random.whole(0, kMaxDecimals);
    double value = random.with_exponent(-30, 40);
    if (i % 4 == 0) value = std::nearbyint(value * 1e3) / 1e4;
    const char* const end =
        std::to_chars(expected, expected + sizeof expected, value, std::chars_format::fixed, decimals).ptr;
    std::string_view text(expected, static_cast<std::size_t>(end - expected));
    if (text.find_first_of("123456789") == std::string_view::npos && std::signbit(value))
      text.remove_prefix(1);
    ASSERT_EQ(printed(value, 0, {decimals}), text) << value;
  }
}

TEST(PrintNumber, TiesAgreeWithTheCLibraryForAllDecimals) {
  RandomNumbers random(3);
  for (int decimals = 0; decimals <= kMaxDecimals; ++decimals) {
    for (int i = 0; i < 2'000; ++i) {
      // An odd multiple of 2^-(decimals + 1) has one more decimal, a 5.
      const double tie = std::ldexp(2.0 * random.whole(-100'000, 100'000) + 1, -decimals - 1);
      ASSERT_EQ(printed(tie, 0, {decimals}), printed_by_c(tie, decimals)) << std::hexfloat << tie;
    }
  }
}

TEST(PrintNumber, ZeroHasNoSign) {
  for (int decimals = 0; decimals <= kMaxDecimals; ++decimals) {
    EXPECT_EQ(printed(-0.0, 0, {decimals}), printed(0, 0, {decimals}));
    EXPECT_EQ(printed(-1e-300, 0, {decimals}), printed(0, 0, {decimals}));
    EXPECT_EQ(printed(-0x1p-1074, 0, {decimals}), printed(0, 0, {decimals}));
  }
  EXPECT_EQ(printed(-0.00000004, 0, {7}), "0.0000000");
  EXPECT_EQ(printed(-0.00000006, 0, {7}), "-0.0000001");
  EXPECT_EQ(printed(-0.0, 0, {.shortest = true}), "0");
}

TEST(PrintNumber, TheLongestNumbersFit) {
  EXPECT_EQ(printed(-kLargestDouble, 0, {kMaxDecimals}), printed_by_c(-kLargestDouble, kMaxDecimals));
  EXPECT_EQ(printed(-kLargestDouble, 0, {kMaxDecimals}).size(), kMaxNumberLength);
}

TEST(PrintNumber, LowPartShowsTheDigitsADoubleHasNoRoomFor) {
  EXPECT_EQ(printed(1e16, 0.1, {7}), "10000000000000000.1000000");
  EXPECT_EQ(printed(1e16, -0.1, {1}), "9999999999999999.9");
  EXPECT_EQ(printed(-1e16, 0.1, {1}), "-9999999999999999.9");
}

TEST(PrintNumber, LowPartDecidesATie) {
  EXPECT_EQ(printed(0.5, -0x1p-60, {0}), "0");
  EXPECT_EQ(printed(0.5, 0x1p-1074, {0}), "1");
  EXPECT_EQ(printed(1.5, -0x1p-1074, {0}), "1");
  EXPECT_EQ(printed(-2.5, -0x1p-60, {0}), "-3");
}

/// True if a number is printed as to_chars prints it.
bool is_shortest(double value) {
  char expected[kMaxNumberLength];
  char text[kMaxNumberLength];
  const std::string_view right(expected,
                               std::to_chars(expected, expected + sizeof expected, value).ptr - expected);
  return std::string_view(text, print_number(text, value, 0, {.shortest = true}) - text) == right;
}

TEST(PrintNumber, ShortestNumbersAreThoseOfToCharsNearPowersOfTwo) {
  for (int exponent = -45; exponent <= 60; ++exponent)
    for (const double power : {std::ldexp(1.0, exponent), -std::ldexp(1.0, exponent)})
      for (const double value : {power, std::nextafter(power, 0), std::nextafter(power, 2 * power)})
        EXPECT_TRUE(is_shortest(value)) << value;
}

TEST(PrintNumber, ShortestNumbersAreThoseOfToCharsNearPowersOfTen) {
  for (int exponent = -15; exponent <= 20; ++exponent)
    for (int factor = 1; factor < 100; ++factor) {
      const double power =
          std::strtod((std::to_string(factor) + "e" + std::to_string(exponent)).c_str(), nullptr);
      for (const double value : {power, std::nextafter(power, 0), std::nextafter(power, 2 * power)})
        EXPECT_TRUE(is_shortest(value)) << value;
    }
}

// Of 1 to 17 digits, the doubles beside them, and numbers whose decimal ends in a 5 or at the border of those
// that read back, where one product does not decide.
TEST(PrintNumber, ShortestNumbersAreThoseOfToCharsForAnyCountOfDigits) {
  RandomNumbers random(7);
  for (int i = 0; i < 300'000; ++i) {
    const double digits = std::nearbyint(random.with_exponent(0, 52));
    const double decimal = digits / std::pow(10.0, random.whole(0, 18));
    for (const double value : {decimal, std::nextafter(decimal, HUGE_VAL), std::nextafter(decimal, -HUGE_VAL),
                               std::ldexp(std::nearbyint(random.with_exponent(0, 54)), -random.whole(0, 60))})
      ASSERT_TRUE(is_shortest(value) || value == 0) << std::hexfloat << value;
  }
}

TEST(PrintNumber, ShortestNumbersAreThoseOfToCharsWhereTheFormChanges) {
  for (const double border :
       {0.001, 0.01, 1e4, 1e5, 1e6, 0.0001, 1e15, 1e16, 0x1p53, 0x1p-40, 9999999.5, 0.1234567}) {
    double below = border;
    double above = border;
    for (int i = 0; i < 1000; ++i) {
      for (const double value : {below, -below, above, -above}) ASSERT_TRUE(is_shortest(value)) << value;
      below = std::nextafter(below, 0);
      above = std::nextafter(above, HUGE_VAL);
    }
  }
  for (int i = 1; i <= 200'000; ++i)
    ASSERT_TRUE(is_shortest(i) && is_shortest(i * 1e-7) && is_shortest(i / 128.0)) << i;
}

// Numbers with many digits and with few, of every magnitude of coordinates.
TEST(PrintNumberLong, ShortestNumbersAreThoseOfToChars) {
  RandomNumbers random(6);
  for (int i = 0; i < 100'000'000; ++i) {
    double value = random.with_exponent(-42, 55);
    if (i % 4 == 0) value = std::nearbyint(value * 1e5) / 1e6;
    ASSERT_TRUE(is_shortest(value) || value == 0) << value;
  }
}

TEST(PrintNumber, TheLocaleHasNoInfluence) {
  const bool is_set = set_comma_locale();
  const std::string text = printed(1.5, 0, {1});
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(text, "1.5");
  if (!is_set) GTEST_SKIP() << "no locale with a decimal comma is installed";
}

TEST(PrintShortestFloat, AgreesWithToChars) {
  RandomNumbers random(6);
  for (int i = 0; i < 600'000; ++i) {
    const double wide = i % 2 == 0 ? random.with_exponent(-12, 14) : random.with_exponent(-140, 120);
    const auto value = static_cast<float>(i % 3 == 0 ? std::nearbyint(wide * 1e6) / 1e6 : wide);
    char text[kMaxFloatLength], expected[kMaxFloatLength];
    char* const end = std::to_chars(expected, expected + sizeof expected, value == 0 ? 0.0F : value).ptr;
    ASSERT_EQ(std::string(text, print_shortest_float(text, value)), std::string(expected, end));
  }
}

}  // namespace
}  // namespace pipeline
