#include "libpipeline/scene/color.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace pipeline {
namespace {

/// The generator of the hand-outs, step by step from its seed.
Color color_by_counting(std::uint64_t number) {
  std::uint64_t s = 1;
  std::uint8_t rgb[3] = {};
  for (std::uint64_t draw = 0; draw < 3 * number + 3; ++draw) {
    s = (214013 * s + 2531011) % (std::uint64_t{1} << 32);
    rgb[draw % 3] = static_cast<std::uint8_t>((s / 65536) % 32768 % 256);
  }
  return {rgb[0], rgb[1], rgb[2]};
}

TEST(Color, KeepsItsChannelsApart) {
  constexpr Color color(1, 128, 255);
  EXPECT_EQ(color.red(), 1);
  EXPECT_EQ(color.green(), 128);
  EXPECT_EQ(color.blue(), 255);
  EXPECT_EQ(color.rgb(), 0x0180ffu);
  EXPECT_EQ(Color::from_rgb(0x0180ff), color);
}

TEST(TriangleColors, StartWithTheKnownNumbersOfTheGenerator) {
  // Visual C++'s rand() without srand() begins 41, 18467, 6334, 26500, 19169, 15724, 11478, 29358, 26962.
  TriangleColors colors;
  EXPECT_EQ(colors.of(0), Color(41, 18467 % 256, 6334 % 256));
  EXPECT_EQ(colors.of(1), Color(26500 % 256, 19169 % 256, 15724 % 256));
  EXPECT_EQ(colors.of(2), Color(11478 % 256, 29358 % 256, 26962 % 256));
}

TEST(TriangleColors, AJumpGivesWhatCountingGives) {
  TriangleColors colors;
  for (const std::uint64_t number : {7, 3, 1000, 999, 1001, 65536, 123456})
    EXPECT_EQ(colors.of(number), color_by_counting(number));
}

TEST(TriangleColors, ATriangleHasOneColorHoweverOftenItIsAsked) {
  TriangleColors colors;
  const Color color = colors.of(5);
  EXPECT_EQ(colors.of(5), color);
  EXPECT_EQ(colors.of(5), color);
  EXPECT_EQ(colors.of(6), color_by_counting(6));
}

TEST(TriangleColors, RepeatAfterThePeriodOfTheGenerator) {
  // 2^32 is the period (Hull and Dobell, 1962), and 3 is odd: triangles repeat after 2^32, not before.
  constexpr std::uint64_t kPeriod = std::uint64_t{1} << 32;
  TriangleColors colors;
  EXPECT_EQ(colors.of(kPeriod + 17), color_by_counting(17));
  EXPECT_EQ(colors.of(std::numeric_limits<std::uint64_t>::max() - kPeriod + 1 + 17), color_by_counting(17));
}

TEST(TriangleColors, TheLastNumberIsFollowedByTheFirst) {
  TriangleColors colors;
  // Three draws before the start of the period, whose state is then 1 again.
  colors.of(std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(colors.of(0), Color(41, 35, 190));
}

TEST(ParseColor, TakesSixHexadecimalDigits) {
  EXPECT_EQ(parse_color("0a1B9f"), Color(0x0a, 0x1b, 0x9f));
  EXPECT_EQ(parse_color("FFFFFF"), Color(255, 255, 255));
  EXPECT_EQ(parse_color("000000"), Color());
}

TEST(ParseColor, TakesAnAlphaBehindThem) {
  const Color color = parse_color("0a1B9f7F").value();
  EXPECT_EQ(color, Color(0x0a, 0x1b, 0x9f).with_alpha(0x7f));
  EXPECT_EQ(color.red(), 0x0a);
  EXPECT_EQ(color.green(), 0x1b);
  EXPECT_EQ(color.blue(), 0x9f);
  EXPECT_EQ(color.alpha(), 0x7f);
  EXPECT_FALSE(color.is_opaque());
  EXPECT_EQ(parse_color("0a1b9fFF"), Color(0x0a, 0x1b, 0x9f));
  EXPECT_TRUE(Color(1, 2, 3).is_opaque());
  EXPECT_EQ(Color(1, 2, 3).alpha(), 255);
}

TEST(ParseColor, TakesNothingElse) {
  for (const char* const word : {"", "fff", "12345", "1234567", "#12345", "12345g", "12345G", "0x1234",
                                 "12 456", "-12345", "1234567g", "123456789"})
    EXPECT_EQ(parse_color(word), std::nullopt) << word;
}

}  // namespace
}  // namespace pipeline
