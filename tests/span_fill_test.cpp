#include "libpipeline/span_fill.h"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace pipeline {
namespace {

constexpr int kColumns = 41;
constexpr ScreenConfig kScreen = {kColumns, 1, -1, -1, 0.25, 0.75};

/// Every claim is made of every kernel that this processor can run.
class SpanFillTest : public testing::TestWithParam<SpanFillKernel> {};

template <typename Depth>
struct PixelRow {
  std::vector<typename Depth::Stored> depths;
  std::vector<Color> colors;

  friend bool operator==(const PixelRow&, const PixelRow&) = default;
};

/// What a span does to a row, pixel by pixel.
template <typename Depth>
void draw_slowly(PixelRow<Depth>& row, const Span& span, Color color, const Depth& format) {
  for (int column = span.first_column; column <= span.last_column; ++column) {
    const auto i = static_cast<std::size_t>(column);
    const double z = span.depth(column);
    if (z < kScreen.front || format.store(z) >= row.depths[i]) continue;
    row.depths[i] = format.store(z);
    row.colors[i] = color;
  }
}

/// Spans of every length from every column, with depths that tie, cross the limits, or are not finite.
template <typename Depth>
void expect_pixels_of_a_loop(const SpanFillKernel& kernel) {
  const Depth format(kScreen);
  PixelRow<Depth> expected = {std::vector(kColumns, format.store(kScreen.rear)),
                              std::vector<Color>(kColumns)};
  PixelRow<Depth> found = expected;
  std::mt19937_64 random(1);
  const auto between = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  std::uint32_t number = 0;
  for (int first = 0; first < kColumns; ++first) {
    for (int last = first; last < kColumns; ++last) {
      const double slope = between(0, 50) == 0 ? 1e308 : between(-8, 8) / 3000.0;
      const Span span = {0, first, last, {0.1, 0.1, between(0, 9) * 0.5, between(0, 64) / 64.0, slope}};
      const Color color = Color::from_rgb(++number);
      draw_slowly(expected, span, color, format);
      const auto place = static_cast<std::size_t>(first);
      kernel.fill(
          SpanFill<Depth>{span, color, format, kScreen.front, &found.depths[place], &found.colors[place]});
      ASSERT_TRUE(found == expected) << "columns " << first << " to " << last;
      if (number % 100 == 0) {
        std::fill(expected.depths.begin(), expected.depths.end(), format.store(kScreen.rear));
        found = expected;
      }
    }
  }
}

TEST_P(SpanFillTest, DoublesAreThoseOfALoopOverPixels) {
  expect_pixels_of_a_loop<DepthF64>(GetParam());
}
TEST_P(SpanFillTest, FloatsAreThoseOfALoopOverPixels) {
  expect_pixels_of_a_loop<DepthF32>(GetParam());
}
TEST_P(SpanFillTest, StepsAreThoseOfALoopOverPixels) {
  expect_pixels_of_a_loop<DepthU24>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Kernels, SpanFillTest,
                         testing::ValuesIn(span_fill_kernels().begin(), span_fill_kernels().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pipeline
