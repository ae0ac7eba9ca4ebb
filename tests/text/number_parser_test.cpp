#include "libpipeline/text/number_parser.h"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "tests/numbers/random_numbers.h"
#include "tests/text/comma_locale.h"

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

TEST(ParseNumber, TakesEveryDecimalForm) {
  for (const auto& [word, value] : {std::pair{"0"sv, 0.0},
                                    {"-3.25", -3.25},
                                    {"007.50", 7.5},
                                    {"-0.0", -0.0},
                                    {"+1", 1},
                                    {"+.5", 0.5},
                                    {"5.", 5},
                                    {"-.5", -0.5},
                                    {"5.e1", 50},
                                    {"1e5", 1e5},
                                    {"1E+5", 1e5},
                                    {"1e-5", 1e-5},
                                    {"1e0005", 1e5}})
    expect_number(word, value);
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

TEST(ParseNumber, DigitsBeforeAndBehindThePointCountAgainstTheExponent) {
  const std::string zeros(400, '0');
  expect_overflow("1" + zeros + "e-50");
  expect_overflow("-1" + zeros + ".5e-50");
  expect_number("0." + zeros + "1e50", 0);
  expect_number("-." + zeros + "1e+50", -0.0);
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
       {"nan"sv,   "NaN"sv,   "inf"sv,   "-inf"sv,  "+inf"sv,   "infinity"sv, "0x10"sv, "0x1p3"sv,
        "1e5.0"sv, "ten"sv,   "1_000"sv, "½"sv,     "1,5"sv,    "1.5."sv,     "1 "sv,   "1-"sv,
        "1f"sv,    "1.2.3"sv, "1e"sv,    "1e+"sv,   "1e-"sv,    "1e+-1"sv,    ""sv,     "+"sv,
        "-"sv,     "."sv,     "-."sv,    "+."sv,    "e5"sv,     ".e5"sv,      "+-1"sv,  "--1"sv,
        "++1"sv,   "-+1"sv,   "1\0"sv,   "\0001"sv, "1\0002"sv, " 1"sv})
    expect_no_number(word);
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

TEST(ParseNumber, TheLocaleHasNoInfluence) {
  const bool is_set = set_comma_locale();
  const double value = parse_number("1.5").value;
  std::setlocale(LC_ALL, "C");
  EXPECT_EQ(value, 1.5);
  if (!is_set) GTEST_SKIP() << "no locale with a decimal comma is installed";
}

TEST(ParseExactDecimal, TakesUpToSevenDecimals) {
  DoubleDouble value;
  for (const std::string_view word : {"0", "-3", "5.", "0.1234567", "-.1234567", "+900000000.0000001"}) {
    EXPECT_TRUE(parse_exact_decimal(word, value)) << word;
    EXPECT_EQ(value.hi, parse_number(word).value) << word;
  }
  for (const std::string_view word :
       {"0.12345678", "0.00000000", "1e0", "2.5E-3", "1e22", "10000000000000000000000"})
    EXPECT_FALSE(parse_exact_decimal(word, value)) << word;
}

TEST(ParseExactDecimal, GivesThePartThatADoubleDoesNotHold) {
  // The doubles next to each other here are 2^-23, 2^-16 and 2^7 apart; below 9e8 the double is enough.
  DoubleDouble value;
  EXPECT_TRUE(parse_exact_decimal("1073741824.0000001", value));
  EXPECT_EQ(value, (DoubleDouble{1073741824, 1e-7}));
  EXPECT_TRUE(parse_exact_decimal("-68719476736.0000030", value));
  EXPECT_EQ(value, (DoubleDouble{-68719476736, -3e-6}));
  EXPECT_TRUE(parse_exact_decimal("1152921504606847001.", value));
  EXPECT_EQ(value, (DoubleDouble{1152921504606846976, 25}));
  EXPECT_TRUE(parse_exact_decimal("0.1", value));
  EXPECT_EQ(value, (DoubleDouble{0.1, 0}));
}

TEST(ParseCount, TakesDecimalDigitsThatFit) {
  std::uint64_t value = 0;
  EXPECT_TRUE(parse_count("0", value));
  EXPECT_EQ(value, 0u);
  EXPECT_TRUE(parse_count("18446744073709551615", value));
  EXPECT_EQ(value, 18446744073709551615u);
}

TEST(ParseCount, RejectsWhatIsNoCount) {
  std::uint64_t value = 0;
  for (const std::string_view word : {"", "-1", "+1", "1.0", "1e3", " 1", "1x", "18446744073709551616"})
    EXPECT_FALSE(parse_count(word, value)) << word;
}

}  // namespace
}  // namespace pipeline
