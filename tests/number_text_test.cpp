#include "libpipeline/number_text.h"

#include <gtest/gtest.h>

#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>

#include "tests/random_numbers.h"

namespace pipeline {
namespace {

using namespace std::string_view_literals;

constexpr double kLargest = std::numeric_limits<double>::max();

void expect_number(std::string_view word, double value) {
  const ParsedNumber parsed = parse_number(word);
  EXPECT_EQ(parsed.error, NumberError::none) << word;
  EXPECT_EQ(parsed.value, value) << word;
  EXPECT_EQ(std::signbit(parsed.value), std::signbit(value)) << word;
}

void expect_no_number(std::string_view word) {
  EXPECT_EQ(parse_number(word).error, NumberError::not_a_number) << "'" << word << "'";
}

void expect_overflow(std::string_view word) {
  EXPECT_EQ(parse_number(word).error, NumberError::overflow) << word;
}

std::string printed(double hi, double lo, NumberFormat format) {
  char text[kMaxNumberLength];
  return {text, print_number(text, hi, lo, format)};
}

/// What the C library prints, which is exact; the sign of a zero left out.
std::string printed_by_c(double value, int decimals) {
  char text[400];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  const std::string result = text;
  const bool is_zero = result.find_first_of("123456789") == std::string::npos;
  return is_zero && result.front() == '-' ? result.substr(1) : result;
}

TEST(ParseNumber, TakesWholeNumbersAndDecimals) {
  expect_number("0", 0);
  expect_number("12", 12);
  expect_number("-3.25", -3.25);
  expect_number("007.50", 7.5);
}

TEST(ParseNumber, TakesALeadingPlus) {
  expect_number("+1", 1);
  expect_number("+.5", 0.5);
  expect_number("+0", 0);
}

TEST(ParseNumber, TakesAPointWithoutDigitsOnOneSide) {
  expect_number(".5", 0.5);
  expect_number("5.", 5);
  expect_number("-.5", -0.5);
  expect_number("5.e1", 50);
}

TEST(ParseNumber, TakesExponents) {
  expect_number("1e5", 1e5);
  expect_number("1E+5", 1e5);
  expect_number("1e-5", 1e-5);
  expect_number("1e0005", 1e5);
}

TEST(ParseNumber, KeepsTheSignOfZero) {
  expect_number("-0.0", -0.0);
}

TEST(ParseNumber, TakesTheNearestDouble) {
  expect_number("0.1", 0.1);
  expect_number("9007199254740993", 9007199254740992);  // a tie, to even
  expect_number("9007199254740993.000000000000000000000000000000000001", 9007199254740994);
}

TEST(ParseNumber, WhatIsTooSmallIsZeroOfItsSign) {
  expect_number("1e-400", 0);
  expect_number("-1e-400", -0.0);
  expect_number("1e-99999999999999999999", 0);
  expect_number("0." + std::string(100'000, '0') + "1", 0);
}

TEST(ParseNumber, TakesSubnormalNumbers) {
  expect_number("5e-324", 0x1p-1074);
  expect_number("1e-320", 2024 * 0x1p-1074);
}

TEST(ParseNumber, WhatIsTooLargeOverflows) {
  expect_overflow("1e400");
  expect_overflow("-1e400");
  expect_overflow("1.8e308");
  expect_overflow("1e99999999999999999999");
  expect_overflow("0.001e99999999999999999999");
  expect_overflow("1e9223372036854775807");  // 2^63 - 1
  expect_overflow("0.1e9223372036854775807");
  expect_overflow("1000e9223372036854775807");
  expect_overflow(std::string(100'000, '9'));
}

TEST(ParseNumber, TakesTheLargestDouble) {
  expect_number("1.7976931348623157e308", kLargest);
}

TEST(ParseNumber, ZeroWithAHugeExponentIsZero) {
  expect_number("0e99999999999", 0);
  expect_number("-0.000e+99999999999999999999", -0.0);
}

TEST(ParseNumber, TakesAHundredThousandDigits) {
  expect_number("0." + std::string(100'000, '3'), 1.0 / 3);
  expect_number(std::string(100'000, '0') + "7", 7);
  expect_number("0." + std::string(100'000, '0') + "1e100001", 1);
  expect_number("1" + std::string(100'000, '0') + "e-100000", 1);
}

TEST(ParseNumber, RejectsWhatIsNotDecimal) {
  for (const std::string_view word :
       {"nan", "NaN", "inf", "-inf", "+inf", "infinity", "0x10", "0x1p3", "1e5.0", "ten", "1_000", "½"})
    expect_no_number(word);
}

TEST(ParseNumber, RejectsTrailingCharacters) {
  for (const std::string_view word : {"1,5", "1.5abc", "1.5.", "1 ", "1-", "1f", "1.2.3"})
    expect_no_number(word);
}

TEST(ParseNumber, RejectsAnExponentWithoutDigits) {
  for (const std::string_view word : {"1e", "1e+", "1e-", "1e+-1"}) expect_no_number(word);
}

TEST(ParseNumber, RejectsWordsWithoutDigits) {
  for (const std::string_view word : {"", "+", "-", ".", "-.", "+.", "e5", ".e5"}) expect_no_number(word);
}

TEST(ParseNumber, RejectsASecondSign) {
  for (const std::string_view word : {"+-1", "--1", "++1", "-+1"}) expect_no_number(word);
}

TEST(ParseNumber, RejectsAnEmbeddedNul) {
  expect_no_number("1\0"sv);
  expect_no_number("\0001"sv);
  expect_no_number("1\0002"sv);
}

TEST(ParseNumber, RejectsBlanksInFront) {
  expect_no_number(" 1");
}

TEST(ParseNumber, ReadsNothingBehindTheWord) {
  expect_number("12345"sv.substr(0, 2), 12);
}

TEST(ParseNumber, AgreesWithTheCLibraryOnRandomDecimals) {
  RandomNumbers random(1);
  for (int i = 0; i < 200'000; ++i) {
    std::string word = random.bits() % 2 == 0 ? "-" : "";
    word += std::to_string(random.bits() >> random.whole(0, 60));
    if (i % 2 == 0) word += "." + std::to_string(random.bits() >> random.whole(0, 60));
    if (i % 3 == 0) word += "e" + std::to_string(random.whole(-330, 285));
    const ParsedNumber parsed = parse_number(word);
    ASSERT_EQ(parsed.error, NumberError::none) << word;
    ASSERT_EQ(parsed.value, std::strtod(word.c_str(), nullptr)) << word;
  }
}

TEST(PrintNumber, AgreesWithTheCLibraryForAnyDoubleAndAnyDecimals) {
  RandomNumbers random(2);
  for (int i = 0; i < 100'000; ++i) {
    const double value = i % 2 == 0 ? random.any_double() : random.with_exponent(-70, 70);
    const int decimals = random.whole(0, kMaxDecimals);
    ASSERT_EQ(printed(value, 0, {decimals}), printed_by_c(value, decimals)) << std::hexfloat << value;
  }
}

// Numbers of the size that coordinates have, many of them a few digits long: near and on ties.
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

TEST(PrintNumber, TiesAreRoundedToEven) {
  EXPECT_EQ(printed(0.5, 0, {0}), "0");
  EXPECT_EQ(printed(1.5, 0, {0}), "2");
  EXPECT_EQ(printed(2.5, 0, {0}), "2");
  EXPECT_EQ(printed(0.00390625, 0, {7}), "0.0039062");
  EXPECT_EQ(printed(0.01171875, 0, {7}), "0.0117188");
}

TEST(PrintNumber, TiesAgreeWithTheCLibraryForAllDecimals) {
  RandomNumbers random(3);
  for (int decimals = 0; decimals <= kMaxDecimals; ++decimals) {
    for (int i = 0; i < 2'000; ++i) {
      // An odd multiple of 2^-(decimals + 1) has one decimal more than that, a 5.
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
  EXPECT_EQ(printed(-kLargest, 0, {kMaxDecimals}), printed_by_c(-kLargest, kMaxDecimals));
  EXPECT_EQ(printed(-kLargest, 0, {kMaxDecimals}).size(), kMaxNumberLength);
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

TEST(PrintNumber, ShortestNumbersReadBackAsTheSameDouble) {
  RandomNumbers random(4);
  for (int i = 0; i < 100'000; ++i) {
    const double value = random.any_double();
    const std::string text = printed(value, 0, {.shortest = true});
    ASSERT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
    ASSERT_LE(text.size(), 24u) << text;
  }
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

// Numbers of many digits and of few, of every size that coordinates have.
TEST(PrintNumberLong, ShortestNumbersAreThoseOfToChars) {
  RandomNumbers random(6);
  for (int i = 0; i < 100'000'000; ++i) {
    double value = random.with_exponent(-42, 55);
    if (i % 4 == 0) value = std::nearbyint(value * 1e5) / 1e6;
    ASSERT_TRUE(is_shortest(value) || value == 0) << value;
  }
}

TEST(PrintNumber, ShortestNumbersAreShort) {
  EXPECT_EQ(printed(0.1, 0, {.shortest = true}), "0.1");
  EXPECT_EQ(printed(3, 0, {.shortest = true}), "3");
  EXPECT_EQ(printed(1e300, 0, {.shortest = true}), "1e+300");
}

TEST(PrintNumber, TheLocaleHasNoInfluence) {
  const char* const locales[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
  bool is_set = false;
  for (const char* locale : locales) is_set = is_set || std::setlocale(LC_ALL, locale) != nullptr;
  const std::string text = printed(1.5, 0, {1});
  const double value = parse_number("1.5").value;
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(text, "1.5");
  EXPECT_EQ(value, 1.5);
  if (!is_set) GTEST_SKIP() << "no locale with a decimal comma is installed";
}

TEST(ParseCount, TakesDecimalDigitsThatFit) {
  std::size_t value = 0;
  EXPECT_TRUE(parse_count("0", value));
  EXPECT_EQ(value, 0u);
  EXPECT_TRUE(parse_count("18446744073709551615", value));
  EXPECT_EQ(value, 18446744073709551615u);
}

TEST(ParseCount, RejectsWhatIsNoCount) {
  std::size_t value = 0;
  for (const std::string_view word : {"", "-1", "+1", "1.0", "1e3", " 1", "1x", "18446744073709551616"})
    EXPECT_FALSE(parse_count(word, value)) << word;
}

TEST(RoundsSafely, TakesANumberFarFromATie) {
  EXPECT_TRUE(rounds_safely(0.12345670, 1e-12, {7}));
}

TEST(RoundsSafely, RefusesANumberWithinItsErrorOfATie) {
  EXPECT_FALSE(rounds_safely(0.12345675, 1e-16, {7}));
  EXPECT_FALSE(rounds_safely(0.5, 0, {0}));
}

TEST(RoundsSafely, RefusesInfinitiesAndNan) {
  EXPECT_FALSE(rounds_safely(HUGE_VAL, 0, {7}));
  EXPECT_FALSE(rounds_safely(-HUGE_VAL, 0, {7}));
  EXPECT_FALSE(rounds_safely(NAN, 0, {7}));
  EXPECT_FALSE(rounds_safely(1, HUGE_VAL, {7}));
  EXPECT_FALSE(rounds_safely(1, NAN, {7}));
}

TEST(RoundsSafely, TakesAShortestNumberOnlyWithoutError) {
  EXPECT_TRUE(rounds_safely(0.1, 0, {.shortest = true}));
  EXPECT_FALSE(rounds_safely(0.1, 0x1p-1074, {.shortest = true}));
}

}  // namespace
}  // namespace pipeline
