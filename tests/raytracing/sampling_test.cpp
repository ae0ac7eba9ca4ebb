#include "libpipeline/raytracing/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <vector>

#include "libpipeline/picture/supersampling.h"

namespace pipeline {
namespace {

constexpr int kPlaces = SamplePlaces::kJitterPlaces;

TEST(SamplePlaces, RegularOnesAreThePixelsOfTheSampleScreen) {
  const Viewport pixels = {.columns = 7, .rows = 5};
  const SamplePlaces places(pixels, 3, false);
  EXPECT_EQ(places.screen(), sample_screen(pixels, 3));
  EXPECT_EQ(places.of(0, 0, 0), (SamplePlaces::Place{0, 0}));
  EXPECT_EQ(places.of(2, 4, 5), (SamplePlaces::Place{7, 14}));  // second row of cells, last column
  EXPECT_EQ(places.of(4, 6, 8), (SamplePlaces::Place{14, 20}));
}

TEST(SamplePlaces, AJitteredOneIsInItsCell) {
  const SamplePlaces places({.columns = 65535, .rows = 65535}, 4, true);
  for (const int row : {0, 1, 300, 65534})
    for (const int column : {0, 7, 65534})
      for (int sample = 0; sample < 16; ++sample) {
        const auto place = places.of(row, column, sample);
        EXPECT_EQ(place.row / kPlaces, 4 * row + sample / 4);
        EXPECT_EQ(place.column / kPlaces, 4 * column + sample % 4);
      }
}

TEST(SamplePlaces, TheFinestScreenHasRoomInAnInt) {
  const SamplePlaces places({.columns = 65535, .rows = 65535}, kMaxSamples, true);
  EXPECT_EQ(places.screen().columns, 65535 * 16 * 256);
  const auto last = places.of(65534, 65534, 255);
  EXPECT_EQ(last.row / kPlaces, 65535 * 16 - 1);
  EXPECT_EQ(last.column / kPlaces, 65535 * 16 - 1);
}

/// The sum of squares of the differences between counts and their mean, over the mean.
double chi_squared(const std::vector<int>& counts) {
  double sum = 0, squares = 0;
  for (const int count : counts) sum += count;
  const double mean = sum / static_cast<double>(counts.size());
  for (const int count : counts) squares += (count - mean) * (count - mean);
  return squares / mean;
}

TEST(SamplePlaces, JitteredOnesAreSpreadEvenlyOverTheirCell) {
  const SamplePlaces places({.columns = 256, .rows = 256}, 2, true);
  std::vector<int> rows(kPlaces), columns(kPlaces), quarters(16 * 16);
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column)
      for (int sample = 0; sample < 4; ++sample) {
        const auto place = places.of(row, column, sample);
        ++rows[static_cast<std::size_t>(place.row % kPlaces)];
        ++columns[static_cast<std::size_t>(place.column % kPlaces)];
        ++quarters[static_cast<std::size_t>(place.row % kPlaces / 16 * 16 + place.column % kPlaces / 16)];
      }
  // 255 degrees of freedom: a mean of 255, a standard deviation of 22.6.
  for (const auto* counts : {&rows, &columns, &quarters}) {
    EXPECT_GT(chi_squared(*counts), 255 - 4 * 22.6);
    EXPECT_LT(chi_squared(*counts), 255 + 4 * 22.6);
  }
}

TEST(SamplePlaces, NeighborsAreNotAlike) {
  const SamplePlaces places({.columns = 128, .rows = 128}, 1, true);
  const auto offset = [&](int row, int column) {
    return (places.of(row, column, 0).column % kPlaces + 0.5) / kPlaces - 0.5;
  };
  for (const auto& [down, right] : {std::pair{0, 1}, {1, 0}, {1, 1}}) {
    double products = 0;
    for (int row = 0; row < 127; ++row)
      for (int column = 0; column < 127; ++column)
        products += offset(row, column) * offset(row + down, column + right);
    // Of independent ones: 0, with a standard deviation of 1 / 12 over the root of their number.
    EXPECT_LT(std::fabs(products / (127 * 127)), 4.0 / 12 / 127);
  }
}

TEST(SampleOrder, CornersAndMiddleComeFirst) {
  const std::vector<int> samples = sample_order(5);
  EXPECT_EQ(std::vector<int>(samples.begin(), samples.begin() + kFirstSamples),
            (std::vector<int>{0, 4, 12, 20, 24}));
}

TEST(SampleOrder, HasEverySampleOnce) {
  for (int count = 1; count <= kMaxSamples; ++count) {
    const std::vector<int> samples = sample_order(count);
    const std::set<int> numbers(samples.begin(), samples.end());
    EXPECT_EQ(samples.size(), static_cast<std::size_t>(count * count));
    EXPECT_EQ(numbers.size(), samples.size());
    EXPECT_EQ(*numbers.rbegin(), count * count - 1);
  }
}

TEST(LargestDifference, IsThatOfTheChannelThatDiffersMostOrOfAlpha) {
  const std::vector<Color> colors = {{10, 20, 30}, {12, 90, 0}, {11, 0, 255}};
  EXPECT_EQ(largest_difference(std::span(colors).first(1)), 0);
  EXPECT_EQ(largest_difference(std::span(colors).first(2)), 70);
  EXPECT_EQ(largest_difference(colors), 255);
  EXPECT_EQ(largest_difference(std::vector{Color(10, 20, 30), Color(10, 20, 30).with_alpha(55)}), 200);
}

/// The means of both, of samples that have the background's color or are opaque.
void expect_mean_of_downsampler(const std::vector<Color>& samples, Color background) {
  Downsampler means(1, 4, background);
  ColorMean mean;
  for (std::size_t row = 0; row < 4; ++row) {
    const auto pixel = means.add(std::span(samples).subspan(4 * row, 4));
    for (std::size_t i = 0; i < 4; ++i) mean.add(samples[4 * row + i]);
    ASSERT_EQ(pixel.has_value(), row == 3);
    if (pixel) {
      EXPECT_EQ((*pixel)[0], mean.mean());
    }
  }
}

TEST(ColorMean, IsThatOfTheRegularSamples) {
  for (const int alpha : {255, 254, 128, 1, 0}) {
    const Color background = Color(250, 3, 77).with_alpha(static_cast<std::uint8_t>(alpha));
    for (int shown = 0; shown <= 16; ++shown) {
      std::vector<Color> samples(16, background);
      for (int i = 0; i < shown; ++i)
        samples[static_cast<std::size_t>(5 * i % 16)] =
            Color(static_cast<std::uint8_t>(i * i), static_cast<std::uint8_t>(255 - 3 * i),
                  static_cast<std::uint8_t>(i % 2 * 255));
      expect_mean_of_downsampler(samples, background);
    }
  }
}

}  // namespace
}  // namespace pipeline
