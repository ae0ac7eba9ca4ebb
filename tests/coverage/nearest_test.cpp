#include "libpipeline/coverage/nearest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/numbers/any_numbers.h"

namespace pipeline {
namespace {

using Picture = std::vector<std::string>;

// Pixels of size 1, centers at -3.5, -2.5 ... 3.5 in x and y: all small halves are exact.
constexpr Viewport kEightPixels = {8, 8, -4, -4, -1, 1};
// The assignment's example: pixels of size 0.004.
constexpr Viewport kExample = {500, 500, -1, -1, 0, 2};

std::vector<Span> spans_of(const Triangle& p_ndc, const Viewport& screen) {
  std::vector<Span> spans;
  for_each_span(NearestRows(PixelGrid(screen), p_ndc), [&](const Span& span) { spans.push_back(span); });
  return spans;
}

Picture picture_of(const Triangle& p_ndc, const Viewport& screen = kEightPixels) {
  Picture picture(static_cast<std::size_t>(screen.rows),
                  std::string(static_cast<std::size_t>(screen.columns), '.'));
  for (const Span& span : spans_of(p_ndc, screen))
    for (int column = span.first_column; column <= span.last_column; ++column)
      picture[static_cast<std::size_t>(span.row)][static_cast<std::size_t>(column)] = '#';
  return picture;
}

const Picture kNoPixel(8, "........");

TEST(CoverageNearest, TakesThePixelsNearestToBothEdges) {
  // On the row at y the edges are at x = -3 + (y + 3) / 2 and its mirror image.
  EXPECT_EQ(picture_of({{{-3, -3, 0}, {3, -3, 0}, {0, 3, 0}}}), (Picture{
                                                                    "........",
                                                                    "...##...",
                                                                    "...##...",
                                                                    "..####..",
                                                                    "..####..",
                                                                    ".######.",
                                                                    ".######.",
                                                                    "........",
                                                                }));
}

TEST(CoverageNearest, ARowThroughTheLowestOrTheHighestPointHasIt) {
  EXPECT_EQ(picture_of({{{-1.5, -1.5, 0}, {1.5, -1.5, 0}, {0.5, 1.5, 0}}}), (Picture{
                                                                                "........",
                                                                                "........",
                                                                                "....#...",
                                                                                "...##...",
                                                                                "...###..",
                                                                                "..####..",
                                                                                "........",
                                                                                "........",
                                                                            }));
}

TEST(CoverageNearest, BetweenTwoRowsThereIsNothing) {
  EXPECT_EQ(picture_of({{{-3, -0.4, 0}, {3, -0.4, 0}, {0, 0.4, 0}}}), kNoPixel);
}

TEST(CoverageNearest, TheBorderItselfBelongsToTheLeftAndNotToTheRight) {
  // floor((-4 - -3.5) + 0.5) = 0, floor((4 - -3.5) + 0.5) = 8.
  EXPECT_EQ(picture_of({{{-4, -1, 0}, {-4, 1, 0}, {-6, 0, 0}}})[4], "#.......");
  EXPECT_EQ(picture_of({{{4, -1, 0}, {4, 1, 0}, {6, 0, 0}}}), kNoPixel);
}

TEST(CoverageNearest, ALineIsDrawnAndItsSmallerDepthHolds) {
  const Triangle line = {{{-1.5, -1.5, 0.25}, {0.5, 0.5, 0.5}, {1.5, 1.5, 0.75}}};
  EXPECT_EQ(picture_of(line), (Picture{
                                  "........",
                                  "........",
                                  ".....#..",
                                  "....#...",
                                  "...#....",
                                  "..#.....",
                                  "........",
                                  "........",
                              }));
  // On the long edge depth goes from 0.25 to 0.75 over three rows, on the other two it is 0.5 at (0.5, 0.5).
  const std::vector<Span> spans = spans_of(line, kEightPixels);
  EXPECT_EQ(spans[0].depth(5), 0.75);
  EXPECT_EQ(spans[1].depth(4), 0.5);
  EXPECT_EQ(spans[2].depth(3), 0.375);
  EXPECT_EQ(spans[3].depth(2), 0.25);
}

TEST(CoverageNearest, ATriangleSeenEdgeOnKeepsItsSmallerDepthWhereRoundingMakesItLean) {
  // As doubles, 0.1, 0.2 and 0.3 are not exactly on a line; a slope computed from them would be noise.
  for (const Span& span : spans_of({{{0.1, 0.1, 0.3}, {0.2, 0.2, 0.9}, {0.3, 0.3, 0.5}}}, kExample)) {
    const double y = 0.998 - 0.004 * span.row;
    EXPECT_NEAR(span.depth(span.first_column), 0.3 + (y - 0.1), 1e-9);
  }
}

TEST(CoverageNearest, DepthIsLinearFromEdgeToEdge) {
  // z = 0.5 + x / 8 + y / 16.
  const auto z = [](double x, double y) { return 0.5 + x / 8 + y / 16; };
  const Triangle triangle = {{{-3, -3, z(-3, -3)}, {3, -2, z(3, -2)}, {0, 3, z(0, 3)}}};
  for (const Span& span : spans_of(triangle, kEightPixels))
    for (int column = span.first_column; column <= span.last_column; ++column)
      EXPECT_NEAR(span.depth(column), z(-3.5 + column, 3.5 - span.row), 1e-15);
}

TEST(CoverageNearest, OnTheRowOfACornerDepthIsThatOfTheCorner) {
  const std::vector<Span> spans =
      spans_of({{{-1.5, -1.5, 1}, {1.5, -1.5, 0}, {0.25, 1.5, 0.125}}}, kEightPixels);
  EXPECT_EQ(spans.front().depth(spans.front().first_column), 0.125);
}

TEST(CoverageNearest, NextToACornerDepthKeepsTheSlopeOfThePlane) {
  // In decimals the corner's y is that of a row, but not exactly: the row crosses the triangle in two points
  // whose distance is a rounding error, and the quotient of their differences is meaningless.
  const auto z = [](double x, double y) { return 1 + 0.5 * x + 0.25 * y; };
  int met_count = 0;
  for (int row = 10; row < 490; ++row) {
    const double y = (998 - 4 * row) / 1000.0;
    const Triangle t = {{{0.1, y, z(0.1, y)}, {-0.3, -1.3, z(-0.3, -1.3)}, {0.7, -1.1, z(0.7, -1.1)}}};
    const Span span = spans_of(t, kExample).front();
    const bool is_exactly_the_corner = span.depth.slope == 0;
    if (span.row != row || is_exactly_the_corner) continue;
    ++met_count;
    EXPECT_NEAR(span.depth(span.first_column), z(-0.998 + 0.004 * span.first_column, y), 1e-12);
  }
  EXPECT_GT(met_count, 50);
}

TEST(CoverageNearest, TheOrderOfTheCornersDoesNotMatter) {
  std::mt19937_64 random(2);
  std::uniform_int_distribution<int> hundredth(-120, 120);
  for (int i = 0; i < 300; ++i) {
    std::array<std::size_t, 3> order = {0, 1, 2};
    Triangle t;
    for (Vec3& p : t) p = {hundredth(random) / 100.0, hundredth(random) / 100.0, hundredth(random) / 100.0};
    const std::vector<Span> expected = spans_of(t, kExample);
    while (std::next_permutation(order.begin(), order.end())) {
      const std::vector<Span> spans = spans_of({t[order[0]], t[order[1]], t[order[2]]}, kExample);
      ASSERT_EQ(spans.size(), expected.size());
      for (std::size_t k = 0; k < spans.size(); ++k) {
        ASSERT_EQ(spans[k].first_column, expected[k].first_column);
        ASSERT_EQ(spans[k].last_column, expected[k].last_column);
        ASSERT_EQ(spans[k].depth(spans[k].first_column), expected[k].depth(expected[k].first_column));
      }
    }
  }
}

TEST(CoverageNearest, AnyFiniteCoordinatesGiveSpansOnTheScreenAndDepthsThatAreNumbers) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<std::size_t> any(0, kAnyNumbers.size() - 1);
  const auto value = [&] { return kAnyNumbers[any(random)]; };
  for (const double limit : {1.0, 1e-200, 1e200}) {
    const Viewport screen = {50, 40, -limit, -limit, -1, 1};
    for (int i = 0; i < 50000; ++i) {
      Triangle t;
      for (Vec3& p : t) p = {value(), value(), value()};
      expect_on_screen(spans_of(t, screen), screen);
      ASSERT_FALSE(HasFatalFailure()) << "triangle " << i;
    }
  }
}

TEST(CoverageNearest, CornersWhoseDifferencesADoubleCannotHoldGiveAPicture) {
  constexpr double kMax = std::numeric_limits<double>::max();
  EXPECT_EQ(picture_of({{{-kMax, -kMax, 0}, {kMax, -kMax, 0}, {0, kMax, 0}}}), Picture(8, "########"));
  EXPECT_EQ(picture_of({{{0.5, -kMax, 0}, {0.5, kMax, 0}, {-kMax, 0, 0}}}), Picture(8, "#####..."));
}

TEST(CoverageNearest, EdgesLongerThanADoubleCanHoldAreCutAtTheRightHeight) {
  // Rows at y = 6, 2, -2 and -6 times 10^307; there the edge from -10^308 to 10^308 is at x = y / 10^308.
  const Viewport screen = {4, 4, -1, -8e307, -1, 1};
  EXPECT_EQ(picture_of({{{-1, -1e308, 0}, {1, 1e308, 0}, {-1, 1e308, 0}}}, screen), (Picture{
                                                                                        "####",
                                                                                        "###.",
                                                                                        "##..",
                                                                                        "#...",
                                                                                    }));
}

TEST(CoverageNearest, DepthsWhoseDifferenceADoubleCannotHoldAreInterpolated) {
  // Along the left edge, x = -3.5, depth goes from -1.5e308 at y = -3.5 to 1.5e308 at y = 3.5.
  const std::vector<Span> spans =
      spans_of({{{-3.5, -3.5, -1.5e308}, {-3.5, 3.5, 1.5e308}, {3.5, -3.5, -1.5e308}}}, kEightPixels);
  ASSERT_EQ(spans.size(), 8u);
  for (const Span& span : spans) EXPECT_NEAR(span.depth(0) / 1.5e308, 1 - span.row / 3.5, 1e-15);
}

TEST(CoverageNearest, ATinyWorldLooksLikeALargeOne) {
  // Multiplying by a power of two is exact; only the range changes.
  const Triangle t = {{{-3, -3, 0.1}, {3, -2, 0.2}, {0.3, 3, 0.7}}};
  const std::vector<Span> expected = spans_of(t, kEightPixels);
  for (const double scale : {0x1p-600, 0x1p600}) {
    Triangle scaled = t;
    for (Vec3& p : scaled) p = {p.x * scale, p.y * scale, p.z};
    const std::vector<Span> spans = spans_of(scaled, {8, 8, -4 * scale, -4 * scale, -1, 1});
    ASSERT_EQ(spans.size(), expected.size());
    for (std::size_t k = 0; k < spans.size(); ++k) {
      EXPECT_EQ(spans[k].first_column, expected[k].first_column);
      EXPECT_EQ(spans[k].last_column, expected[k].last_column);
      EXPECT_EQ(spans[k].depth(spans[k].first_column), expected[k].depth(expected[k].first_column));
    }
  }
}

}  // namespace
}  // namespace pipeline
