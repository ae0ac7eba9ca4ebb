#include "libpipeline/visibility/triangle_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "libpipeline/coverage/rules.h"
#include "tests/sanitizer_rounds.h"

namespace pipeline {
namespace {

/// A triangle whose vertices have these y coordinates.
Triangle at(double a, double b, double c) {
  return {{{0, a, 0}, {1, b, 0}, {0, c, 0}}};
}

TEST(RowBands, HoldEveryRowOnce) {
  for (const Viewport& screen : {Viewport{1, 1}, {1920, 1080}, {500, 500}, {65535, 3}, {1, 65535}}) {
    const RowBands bands(screen);
    int next_row = 0;
    for (int band = 0; band < bands.count(); ++band) {
      EXPECT_EQ(bands.rows(band).first, next_row);
      EXPECT_GT(bands.rows(band).end, next_row);
      next_row = bands.rows(band).end;
    }
    EXPECT_EQ(next_row, screen.rows);
    EXPECT_LE(bands.count(), 512);
  }
}

TEST(RowBands, ATriangleOffTheScreenReachesNone) {
  const RowBands bands({500, 500});
  for (const Triangle& triangle : {at(1.1, 2, 1.5), at(-1.1, -1e300, -2), at(1e300, 1e308, 1e307)}) {
    const RowRange range = bands.bands_of(triangle);
    EXPECT_EQ(range.first, range.end);
  }
}

TEST(RowBands, ATriangleOverTheScreenReachesAll) {
  const RowBands bands({500, 500});
  const RowRange range = bands.bands_of(at(-1e308, 1e308, 0));
  EXPECT_EQ(range.first, 0);
  EXPECT_EQ(range.end, bands.count());
}

TEST(RowBands, InAWindowNextToTheSmallestDoublesATriangleReachesItsRows) {
  const Viewport screen = {10, 640, -1, -1e-310};
  const RowRange range = RowBands(screen).bands_of(at(-0.9e-310, -0.8e-310, -0.9e-310));
  EXPECT_LE(range.first, RowBands(screen).count() - 1);
  EXPECT_EQ(range.end, RowBands(screen).count());
}

TEST(RowBands, ATriangleReachesTheBandsOfItsRows) {
  // 64 rows a band, 2/640 a row: 0.8 is between rows 63 and 64, half a row (0.0015625) away from both.
  const RowBands bands({10, 640});
  ASSERT_EQ(bands.rows(0).end, 64);
  const RowRange above = bands.bands_of(at(0.9, 0.8001, 0.85)),
                 below = bands.bands_of(at(0.7999, 0.75, 0.75));
  EXPECT_EQ(above.first, 0);
  EXPECT_EQ(above.end, 1);
  EXPECT_EQ(below.first, 1);
  EXPECT_EQ(below.end, 2);
}

template <typename Coverage>
void expect_no_span_elsewhere(const Viewport& screen, const Triangle& p_ndc) {
  const RowBands bands(screen);
  const RowRange range = bands.bands_of(p_ndc);
  int first = screen.rows, last = -1;
  for_each_span(Coverage(screen).rows({p_ndc}), [&](const Span& span) {
    first = std::min(first, span.row);
    last = std::max(last, span.row);
  });
  if (last < 0) return;
  ASSERT_LT(range.first, range.end);
  ASSERT_GE(first, bands.rows(range.first).first);
  ASSERT_LT(last, bands.rows(range.end - 1).end);
}

void expect_no_pixel_elsewhere(const Viewport& screen) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < sanitizer_rounds(3000); ++i) {
    // Vertices on, next to and between the lines of pixel centers.
    const auto y = [&] {
      const double on_a_line = screen.top_y() - std::floor(unit(random) * screen.rows) * screen.dy();
      return random() % 3 == 0 ? unit(random) * -screen.bottom
                               : std::nextafter(on_a_line, random() % 2 == 0 ? 1e300 : on_a_line);
    };
    const Triangle triangle = {{{-2 * -screen.left, y(), 0}, {0, y(), 0}, {2 * -screen.left, y(), 0}}};
    expect_no_span_elsewhere<NearestCoverage>(screen, triangle);
    expect_no_span_elsewhere<CenterCoverage>(screen, triangle);
  }
}

TEST(RowBands, NoCoverageRuleHasPixelsElsewhere) {
  for (const Viewport& screen : {Viewport{5, 640}, {5, 1000, -3, -0.7}, {7, 97, -1, -1e100}})
    expect_no_pixel_elsewhere(screen);
}

TEST(RowBands, LongNoCoverageRuleHasPixelsElsewhereInTheHighestPicture) {
  expect_no_pixel_elsewhere({5, 65535, -1, -1e-9});
}

}  // namespace
}  // namespace pipeline
