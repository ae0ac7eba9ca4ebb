#include "libpipeline/visibility/zbuffer.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace pipeline {
namespace {

constexpr PixelTag kRed = 0xff0000;
constexpr PixelTag kGreen = 0x00ff00;
constexpr Viewport kSixByTwo = {6, 2, -1, -1, 0, 2};

/// Columns first to last of a row at the depth z0 + slope * column.
Span span_at(int row, int first_column, int last_column, double z0, double slope = 0) {
  return {row, first_column, last_column, {0, 1, 0, z0, slope}};
}

std::vector<double> depths_of(const ZBuffer<>& buffer, int row) {
  std::vector<std::vector<double>> rows;
  buffer.for_each_row([&](const VisibleRow& r) { rows.emplace_back(r.depths.begin(), r.depths.end()); });
  return rows.at(static_cast<std::size_t>(row));
}

std::vector<PixelTag> tags_of(const ZBuffer<>& buffer, int row) {
  std::vector<std::vector<PixelTag>> rows;
  buffer.for_each_row([&](const VisibleRow& r) { rows.emplace_back(r.tags.begin(), r.tags.end()); });
  return rows.at(static_cast<std::size_t>(row));
}

TEST(ZBuffer, StartsAtTheRearWithTheTagOfTheBackground) {
  const ZBuffer<> buffer(kSixByTwo, kGreen);
  EXPECT_EQ(depths_of(buffer, 1), std::vector<double>(6, 2));
  EXPECT_EQ(tags_of(buffer, 1), std::vector<PixelTag>(6, kGreen));
}

TEST(ZBuffer, TheBackgroundsTagIs0UnlessAnotherIsGiven) {
  EXPECT_EQ(tags_of(ZBuffer<>(kSixByTwo), 0), std::vector<PixelTag>(6, PixelTag{0}));
}

TEST(ZBuffer, ARowWithoutTrianglesIsBackgroundBesideOneWithATriangle) {
  for (const int drawn : {0, 1}) {
    ZBuffer<> buffer(kSixByTwo, kGreen);
    buffer.draw(span_at(drawn, 0, 5, 0.5), kRed);
    EXPECT_EQ(depths_of(buffer, drawn), std::vector<double>(6, 0.5));
    EXPECT_EQ(depths_of(buffer, 1 - drawn), std::vector<double>(6, 2));
    EXPECT_EQ(tags_of(buffer, 1 - drawn), std::vector<PixelTag>(6, kGreen));
  }
}

TEST(ZBuffer, TagsChangeInTheRowsDrawnInto) {
  ZBuffer<> buffer(kSixByTwo, kGreen);
  buffer.draw(span_at(1, 0, 2, 0.5), kRed);
  std::size_t visited = 0;
  buffer.for_each_drawn_row([&](std::span<PixelTag> tags) {
    visited += tags.size();
    for (PixelTag& tag : tags) tag += 1;
  });
  EXPECT_EQ(visited, 6u);
  EXPECT_EQ(tags_of(buffer, 0), std::vector<PixelTag>(6, kGreen));
  EXPECT_EQ(tags_of(buffer, 1),
            (std::vector<PixelTag>{kRed + 1, kRed + 1, kRed + 1, kGreen + 1, kGreen + 1, kGreen + 1}));
}

TEST(ZBuffer, AtEqualDepthTheEarlierTriangleStays) {
  ZBuffer<> buffer(kSixByTwo);
  buffer.draw(span_at(0, 0, 5, 0.1, 0.1), kRed);
  buffer.draw(span_at(0, 0, 5, 0.1, 0.1), kGreen);
  EXPECT_EQ(tags_of(buffer, 0), std::vector<PixelTag>(6, kRed));
}

TEST(ZBuffer, UnderAnEpsilonATriangleMustBeNearerByMore) {
  ZBuffer<> buffer(kSixByTwo);
  buffer.set_depth_epsilon(0.25);
  buffer.draw(span_at(0, 0, 4, 0.5), kRed);
  buffer.draw(span_at(0, 0, 5, 0.375, -0.0625), kGreen);  // nearer by 0.125, 0.1875, 0.25, 0.3125, 0.375
  EXPECT_EQ(tags_of(buffer, 0), (std::vector<PixelTag>{kRed, kRed, kRed, kGreen, kGreen, kGreen}));
}

TEST(ZBuffer, UnderAnEpsilonTheFirstTriangleTakesAnEmptyPixel) {
  ZBuffer<> buffer(kSixByTwo);
  buffer.set_depth_epsilon(0.5);
  buffer.draw(span_at(0, 0, 5, 1.75), kRed);    // the rear is at 2
  buffer.draw(span_at(0, 0, 5, -0.5), kGreen);  // before the front
  EXPECT_EQ(tags_of(buffer, 0), std::vector<PixelTag>(6, kRed));
}

TEST(ZBuffer, InfiniteDepthsAreNotSeen) {
  ZBuffer<> buffer(kSixByTwo);
  buffer.draw(span_at(0, 1, 5, 0, 1e308 * 10), kRed);
  buffer.draw(span_at(0, 1, 5, 0, -1e308 * 10), kRed);
  EXPECT_EQ(tags_of(buffer, 0), std::vector<PixelTag>(6));
}

TEST(ZBuffer, RandomSpansGiveWhatALoopOverPixelsGives) {
  constexpr Viewport kWide = {37, 1, -1, -1, 0.25, 0.75};
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> column(0, 36), sixteenth(0, 16);
  ZBuffer<> buffer(kWide);
  std::vector<double> depths(37, 0.75);
  std::vector<PixelTag> tags(37);
  for (int i = 0; i < 2000; ++i) {
    const int a = column(random), b = column(random);
    const Span span =
        span_at(0, std::min(a, b), std::max(a, b), sixteenth(random) / 16.0, (sixteenth(random) - 8) / 256.0);
    const PixelTag tag = static_cast<PixelTag>(i + 1);
    buffer.draw(span, tag);
    for (int c = span.first_column; c <= span.last_column; ++c) {
      const double z = span.depth.z0 + c * span.depth.slope;
      if (z < 0.25 || z >= depths[static_cast<std::size_t>(c)]) continue;
      depths[static_cast<std::size_t>(c)] = z;
      tags[static_cast<std::size_t>(c)] = tag;
    }
    ASSERT_EQ(depths_of(buffer, 0), depths);
    ASSERT_EQ(tags_of(buffer, 0), tags);
  }
}

template <typename Depth>
std::vector<PixelTag> tags_of_first_row(const ZBuffer<Depth>& buffer) {
  std::vector<PixelTag> tags;
  buffer.for_each_row([&](const VisibleRow& r) {
    if (tags.empty()) tags.assign(r.tags.begin(), r.tags.end());
  });
  return tags;
}

template <typename Depth>
double depth_of_first_pixel(const ZBuffer<Depth>& buffer) {
  std::vector<double> depths;
  buffer.for_each_row([&](const VisibleRow& r) { depths.push_back(r.depths.front()); });
  return depths.front();
}

TEST(ZBuffer, DepthsAFormatCannotTellApartAreEqual) {
  // On a scale from 0 to 2, 2^-18 is 32 steps of 24 bits and 2^-27 is 1/16 of one.
  ZBuffer<DepthU24> told_apart(kSixByTwo), equal(kSixByTwo);
  told_apart.draw(span_at(0, 0, 5, 1 + 0x1p-18), kRed);
  told_apart.draw(span_at(0, 0, 5, 1), kGreen);
  EXPECT_EQ(tags_of_first_row(told_apart), std::vector<PixelTag>(6, kGreen));
  equal.draw(span_at(0, 0, 5, 1 + 0x1p-27), kRed);
  equal.draw(span_at(0, 0, 5, 1), kGreen);
  EXPECT_EQ(tags_of_first_row(equal), std::vector<PixelTag>(6, kRed));
}

TEST(ZBuffer, TwentyFourBitsRoundToTheNearestOf16777215Steps) {
  ZBuffer<DepthU24> buffer(kSixByTwo);
  buffer.draw(span_at(0, 0, 0, 0.5), kRed);  // 4194303.75 steps of 2/16777215: 4194304 of them
  EXPECT_DOUBLE_EQ(depth_of_first_pixel(buffer), 4194304 * 2.0 / 16777215);
}

TEST(ZBuffer, BetweenNarrowLimitsTwentyFourBitsAreFinerThanAFloat) {
  // Floats are 2^-24 apart below 1, a step is 0.001 / 2^24; these depths are 2^-28 apart.
  constexpr Viewport kNarrow = {6, 2, -1, -1, 0.999, 1};
  const Span far_span = span_at(0, 0, 5, 0.9995 + 0x1p-28), near_span = span_at(0, 0, 5, 0.9995);
  ZBuffer<DepthU24> steps(kNarrow);
  steps.draw(far_span, kRed);
  steps.draw(near_span, kGreen);
  EXPECT_EQ(tags_of_first_row(steps), std::vector<PixelTag>(6, kGreen));
  ZBuffer<DepthF32> floats(kNarrow);
  floats.draw(far_span, kRed);
  floats.draw(near_span, kGreen);
  EXPECT_EQ(tags_of_first_row(floats), std::vector<PixelTag>(6, kRed));
}

TEST(ZBuffer, AFloatRoundsToTheNearestFloat) {
  ZBuffer<DepthF32> buffer(kSixByTwo);
  buffer.draw(span_at(0, 0, 0, 0.1), kRed);
  EXPECT_EQ(depth_of_first_pixel(buffer), 0x1.99999ap-4);  // 0.100000001490116, the float nearest to 0.1
}

Viewport between(double front, double rear) {
  return {6, 2, -1, -1, front, rear};
}

TEST(DepthFormat, AFloatTakesLimitsThatAreTwoFloats) {
  // The largest float is 0x1.fffffep127; halfway to 2^128, doubles round to infinity.
  EXPECT_EQ(DepthF32::needed_limits(between(-0x1.fffffefffffffp127, 0x1.fffffefffffffp127)), "");
  EXPECT_NE(DepthF32::needed_limits(between(-0x1.ffffffp127, 0)), "");
  EXPECT_NE(DepthF32::needed_limits(between(0, 0x1.ffffffp127)), "");
  EXPECT_EQ(DepthF32::needed_limits(between(1, 1 + 0x1p-23)), "");
  EXPECT_NE(DepthF32::needed_limits(between(1, 1 + 0x1p-24)), "");
}

TEST(DepthFormat, TwentyFourBitsTakeLimitsWhoseDistanceCanBeDivided) {
  EXPECT_EQ(DepthU24::needed_limits(between(0, 1.7e308)), "");
  EXPECT_EQ(DepthU24::needed_limits(between(-0.8e308, 0.8e308)), "");
  EXPECT_NE(DepthU24::needed_limits(between(-0.9e308, 0.9e308)), "");
  EXPECT_EQ(DepthU24::needed_limits(between(0, 1e-300)), "");
  EXPECT_NE(DepthU24::needed_limits(between(0, 0.9e-300)), "");
}

TEST(DepthFormat, BetweenTheClosestLimitsTwentyFourBitsStillRoundToTheNearestStep) {
  const DepthU24 format(between(0, 1e-300));
  EXPECT_EQ(format.store(0.25e-300), 4194304);  // 4194303.75
  EXPECT_DOUBLE_EQ(format.depth(4194304), 4194304 * 1e-300 / 16777215);
}

TEST(ZBuffer, EveryFormatKeepsTheLimits) {
  ZBuffer<DepthU24> buffer(kSixByTwo);
  buffer.draw(span_at(0, 0, 0, 0), kRed);
  EXPECT_EQ(depth_of_first_pixel(buffer), 0);
  buffer.draw(span_at(0, 1, 1, 2), kRed);
  EXPECT_EQ(tags_of_first_row(buffer)[1], PixelTag());
  buffer.draw(span_at(0, 2, 2, -1e300), kRed);
  EXPECT_EQ(tags_of_first_row(buffer)[2], PixelTag());
}

}  // namespace
}  // namespace pipeline
