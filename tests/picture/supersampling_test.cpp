#include "libpipeline/picture/supersampling.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace pipeline {
namespace {

/// The only pixel of a picture with these samples, row by row.
Color pixel_of(const std::vector<Color>& samples, int count, Color background = {}) {
  Downsampler means(1, count, background);
  const auto side = static_cast<std::size_t>(count);
  for (std::size_t row = 0; row + 1 < side; ++row)
    EXPECT_FALSE(means.add(std::span(samples).subspan(row * side, side)));
  return means.add(std::span(samples).last(side)).value()[0];
}

TEST(Downsampler, RoundsTheMeanOfEachChannelHalvesUp) {
  EXPECT_EQ(pixel_of({{0, 1, 255}, {0, 1, 255}, {0, 0, 255}, {1, 0, 255}}, 2), Color(0, 1, 255));
  EXPECT_EQ(pixel_of({{10, 0, 0}, {20, 0, 0}, {30, 0, 0}, {41, 0, 1}}, 2), Color(25, 0, 0));
}

TEST(Downsampler, OverAnInvisibleBackgroundThePixelHasTheMeanOfTheOthers) {
  const Color none = Color(200, 100, 50).with_alpha(0);
  // A quarter of 255 is 63.75, three quarters are 191.25.
  EXPECT_EQ(pixel_of({none, {9, 8, 7}, none, none}, 2, none), Color(9, 8, 7).with_alpha(64));
  EXPECT_EQ(pixel_of({{10, 0, 1}, {20, 0, 1}, none, {33, 1, 1}}, 2, none), Color(21, 0, 1).with_alpha(191));
  EXPECT_EQ(pixel_of({none, none, none, none}, 2, none), none);
}

TEST(Downsampler, SamplesCountAsMuchAsTheirAlpha) {
  // Alpha 85 is a third: two samples of it weigh as much as two thirds of an opaque one.
  const Color third = Color(60, 0, 255).with_alpha(85);
  EXPECT_EQ(pixel_of({third, {0, 100, 0}, third, {0, 100, 0}}, 2, third), Color(15, 75, 64).with_alpha(170));
  EXPECT_EQ(pixel_of({third, third, third, third}, 2, third), third);
}

TEST(Downsampler, WherePixelsShowNoBackgroundItsAlphaChangesNothing) {
  const std::vector<Color> samples = {{1, 2, 3}, {255, 254, 250}, {7, 77, 177}, {0, 0, 1}};
  for (const int alpha : {0, 1, 128, 254})
    EXPECT_EQ(pixel_of(samples, 2, Color(9, 9, 9).with_alpha(static_cast<std::uint8_t>(alpha))),
              pixel_of(samples, 2));
}

TEST(Downsampler, ForgetsTheRowBefore) {
  const Color none = Color().with_alpha(0);
  Downsampler means(2, 1, none);
  const std::vector<Color> first = {{1, 2, 3}, none}, second = {none, {4, 5, 6}};
  const auto first_row = means.add(first).value();
  EXPECT_EQ(std::vector(first_row.begin(), first_row.end()), first);
  const auto row = means.add(second).value();
  EXPECT_EQ(std::vector(row.begin(), row.end()), second);
}

TEST(Downsampler, KeepsChannelsColumnsAndRowsApart) {
  Downsampler means(2, 2);
  const Color a(255, 0, 1), b(0, 255, 2);
  for (const auto& [left, right] : {std::pair(a, b), std::pair(b, a)}) {
    const std::vector<Color> samples = {left, left, right, right};
    EXPECT_FALSE(means.add(samples));
    const auto row = means.add(samples).value();
    EXPECT_EQ(std::vector(row.begin(), row.end()), std::vector({left, right}));
  }
}

TEST(Downsampler, HoldsTheLargestSums) {
  const Color white = Color(255, 255, 255), almost = white.with_alpha(254);
  std::vector<Color> samples(kMaxSamples * kMaxSamples, white);
  EXPECT_EQ(pixel_of(samples, kMaxSamples, almost), white);
  EXPECT_EQ(pixel_of(samples, kMaxSamples), white);
  samples[0] = almost;
  EXPECT_EQ(pixel_of(samples, kMaxSamples, almost), white);  // an alpha of 254.996
  samples.assign(samples.size(), almost);
  EXPECT_EQ(pixel_of(samples, kMaxSamples, almost), almost);
}

}  // namespace
}  // namespace pipeline
