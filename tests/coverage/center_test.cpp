#include "libpipeline/coverage/center.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "libpipeline/visibility/zbuffer.h"
#include "tests/coverage/center_reference.h"
#include "tests/numbers/any_numbers.h"
#include "tests/numbers/random_numbers.h"

namespace pipeline {
namespace {

using Picture = std::vector<std::string>;

// Pixels of size 1, centers at -3.5, -2.5 ... 3.5 in x and y.
const Viewport kEightByEight = decimal_screen(8, 8, -4, -4);

Picture picture_of(std::string_view triangle, const Viewport& screen = kEightByEight) {
  Owners owners(screen);
  owners.add(triangle_of(triangle));
  return owners.picture();
}

Owners owners_of(const std::vector<TextTriangle>& triangles, const Viewport& screen) {
  Owners owners(screen);
  for (const TextTriangle& triangle : triangles) owners.add(triangle);
  return owners;
}

const Picture kNothing(8, "........");

TEST(CoverageCenter, TakesThePixelsWhoseCentersAreInside) {
  EXPECT_EQ(picture_of("-3 -3 0 3 -3 0 0 3 0"), (Picture{
                                                    "........",
                                                    "........",
                                                    "...##...",
                                                    "...##...",
                                                    "..####..",
                                                    "..####..",
                                                    ".######.",
                                                    "........",
                                                }));
}

TEST(CoverageCenter, BothWindingsAreDrawnAlikeInEveryOrderOfTheCorners) {
  const std::array<std::string_view, 3> corners = {"-3.25 0.5 0.1", "2.5 3.5 0.2", "1.5 -3.75 0.9"};
  const Picture expected = picture_of(joined({corners[0], corners[1], corners[2]}));
  std::array<std::size_t, 3> order = {0, 1, 2};
  while (std::next_permutation(order.begin(), order.end()))
    EXPECT_EQ(picture_of(joined({corners[order[0]], corners[order[1]], corners[order[2]]})), expected);
}

TEST(CoverageCenter, ATriangleWithoutAreaCoversNothing) {
  EXPECT_EQ(picture_of("-3.5 -3.5 0 0.5 0.5 0 3.5 3.5 0"), kNothing);
  EXPECT_EQ(picture_of("-3.5 0.5 0 0.5 0.5 0 3.5 0.5 0"), kNothing);
  EXPECT_EQ(picture_of("0.5 -3.5 0 0.5 0.5 0 0.5 3.5 0"), kNothing);
  EXPECT_EQ(picture_of("0.5 0.5 0 0.5 0.5 0 3.5 3.5 0"), kNothing);
  EXPECT_EQ(picture_of("0.5 0.5 0 0.5 0.5 0 0.5 0.5 0"), kNothing);
}

TEST(CoverageCenter, ADecimalIsThatDecimalAndNotItsNearestDouble) {
  // Pixels of size 0.2: the centers are at -0.9, -0.7 ... None of 0.3, 0.1 and 0.7 is a double.
  const Viewport tenths = decimal_screen(10, 2, -1, -0.2);
  const Picture expected = {"......##..", "......##.."};
  EXPECT_EQ(picture_of("0.3 -0.2 0 0.3 0.2 0 0.7 -0.2 0", tenths)[1], "......##..");
  Owners strip(tenths);
  strip.add(triangle_of("0.3 -0.2 0 0.7 -0.2 0 0.3 0.2 0"));
  strip.add(triangle_of("0.7 0.2 0 0.7 -0.2 0 0.3 0.2 0"));
  EXPECT_EQ(strip.picture(), expected);
}

TEST(CoverageCenter, OtherNumbersAreTheirNearestDoubles) {
  const Viewport tenths = decimal_screen(10, 1, -1, -1);
  // The double nearest to 0.3 is below it, the one nearest to 0.1 above, so the center of column 6 is inside
  // and that of column 5 is not; with the decimals 0.3 and 0.1 both centers would be on left edges, and
  // inside.
  EXPECT_EQ(picture_of("3e-1 -1 0 3e-1 1 0 0.5 -1 0", tenths)[0], "......#...");
  EXPECT_EQ(picture_of("1e-1 -1 0 1e-1 1 0 0.3 -1 0", tenths)[0], "..........");
  EXPECT_EQ(picture_of("0.10000000 -1 0 0.10000000 1 0 0.3 -1 0", tenths)[0], "..........");
  EXPECT_EQ(picture_of("0.1 -1 0 0.1 1 0 0.3 -1 0", tenths)[0], ".....#....");
}

TEST(CoverageCenter, LimitsAreDecimalsToo) {
  // Pixels of size 0.1, centers at -0.25 ... 0.25; the left edge is at 0.05. The double nearest to 0.3 is
  // smaller, and so would be the center of column 3.
  const char* triangle = "0.05 -0.3 0 0.05 0.3 0 0.25 -0.3 0";
  Viewport screen = decimal_screen(6, 6, -0.3, -0.3);
  EXPECT_EQ(picture_of(triangle, screen)[5], "...##.");
  screen.left_is_decimal = false;
  EXPECT_EQ(picture_of(triangle, screen)[5], "....#.");
}

TEST(CoverageCenter, MoreDigitsThanADoubleHasDecide) {
  const auto row_of = [](std::string_view x) {
    return picture_of(
        joined({"-9999999999.5 -10000000000 0", x, "10000000000 0 9000000000 -10000000000 0"}))[4];
  };
  // At y = -0.5 the left edge is at 0.5 - 2.5e-11 and at 0.5 + 1.5e-7; x is the same double in both.
  EXPECT_EQ(row_of("10000000001.5000000"), "....####");
  EXPECT_EQ(row_of("10000000001.5000003"), ".....###");
}

TEST(CoverageCenter, AMeshThroughPixelCentersOwnsEveryPixelOnce) {
  // A quad of two triangles; the diagonal passes through n centers, each owned by one of them.
  constexpr int n = 48;
  const Viewport screen = decimal_screen(n, n);
  const TextTriangle lower = triangle_of("-1 -1 0 1 -1 0 1 1 0"), upper = triangle_of("-1 -1 0 1 1 0 -1 1 0");
  EXPECT_EQ(owners_of({lower, upper}, screen).pixels_with(1), n * n);
  EXPECT_EQ(owners_of({lower}, screen).pixels_with(1), n * (n + 1) / 2);
  EXPECT_EQ(owners_of({upper}, screen).pixels_with(1), n * (n - 1) / 2);
}

TEST(CoverageCenter, ASquareBetweenCentersHasTheTopAndTheLeftOnes) {
  // Centers at odd multiples of 0.05; the square from -0.45 to 0.25 contains 7 x 7 of them.
  const Viewport screen = decimal_screen(20, 20);
  const Owners owners = owners_of({triangle_of("-0.45 -0.45 0 0.25 -0.45 0 0.25 0.25 0"),
                                   triangle_of("-0.45 -0.45 0 0.25 0.25 0 -0.45 0.25 0")},
                                  screen);
  EXPECT_EQ(owners.pixels_with(1), 49);
  EXPECT_EQ(owners.pixels_with(0), 400 - 49);
  EXPECT_EQ(owners.count(7, 5), 1);   // top left: (-0.45, 0.25)
  EXPECT_EQ(owners.count(14, 5), 0);  // bottom left
  EXPECT_EQ(owners.count(7, 12), 0);  // top right
}

TEST(CoverageCenter, AFanAroundAPixelCenterOwnsEveryPixelOnce) {
  const Viewport screen = decimal_screen(20, 14, -1, -0.7);
  const std::array<std::string, 9> rim = {"2 0.05",   "2 2",   "0.05 2", "-0.3 2", "-2 2",
                                          "-2 -0.15", "-2 -2", "0.5 -2", "2 -2"};
  Owners owners(screen);
  for (std::size_t i = 0; i < rim.size(); ++i)
    owners.add(triangle_of(joined({"0.05 0.05 0", rim[i], "0", rim[(i + 1) % rim.size()], "0"})));
  EXPECT_EQ(owners.pixels_with(1), owners.all());
}

/// Splits the triangle at a point inside it, recursively, `depth` times.
void split(const UnitTriangle& t, int depth, RandomNumbers& random, Owners& owners) {
  if (depth == 0) {
    owners.add(triangle_of(t));
    return;
  }
  const int a = random.whole(1, 98), b = random.whole(1, 99 - a);
  UnitTriangle part = t;
  std::array<std::int64_t, 2> point{};
  for (std::size_t axis = 0; axis < 2; ++axis)
    point[axis] = t[2][axis] + (t[0][axis] - t[2][axis]) / 100 * a + (t[1][axis] - t[2][axis]) / 100 * b;
  for (std::size_t i = 0; i < 3; ++i) {
    part = t;
    part[i] = point;
    split(part, depth - 1, random, owners);
  }
}

TEST(CoverageCenter, RandomTriangulationsOwnEveryPixelOnce) {
  RandomNumbers random(1);
  for (const auto& [columns, rows, limit] :
       {std::tuple{64, 48, 1.0}, {33, 57, 0.75}, {1023, 2, 1.0}, {7, 401, 3.1415927}})
    for (int i = 0; i < 20; ++i) {
      Owners owners(decimal_screen(columns, rows, -limit, -limit));
      // Corners of the screen's square and points far outside; each inner point is rounded to 10^-7 once, for
      // all its triangles.
      const std::int64_t far = random.whole(40'000'000, 900'000'000);
      split({{{-far, -far}, {far, -far}, {far, far}}}, 4, random, owners);
      split({{{-far, -far}, {far, far}, {-far, far}}}, 4, random, owners);
      ASSERT_EQ(owners.pixels_with(1), owners.all()) << columns << " x " << rows << ", mesh " << i;
    }
}

TEST(CoverageCenter, VerticesVeryFarAwayShareTheirEdgesToo) {
  const Viewport screen = decimal_screen(100, 80);
  // An edge through the screen between vertices 5e10 pixels away, then 1e15, then beyond.
  for (const char* far : {"1000000000", "20000000000000", "3e25", "1e300"}) {
    const std::string left = std::string("-") + far;
    for (const char* off : {"0.7", "-0.3", "0.0000001"}) {
      const std::string edge = joined({left, off, "0", far, "0.1", "0"});
      const Owners owners = owners_of(
          {triangle_of(joined({edge, "0", far, "0"})), triangle_of(joined({edge, "0", left, "0"}))}, screen);
      EXPECT_EQ(owners.pixels_with(1), owners.all()) << far << ' ' << off;
    }
  }
}

TEST(CoverageCenter, ManyRandomMeshesOfFarDoublesOwnEveryPixelOnce) {
  RandomNumbers random(2);
  for (int i = 0; i < 300; ++i) {
    const Viewport screen = {
        random.whole(1, 40), random.whole(1, 40), -random.between(0.1, 3), -random.between(0.1, 3), -1, 1};
    const double far = std::ldexp(random.between(1, 2), random.whole(3, i % 3 == 0 ? 900 : 55));
    const Vec3 center = {random.between(-0.1, 0.1), random.between(-0.1, 0.1), 0};
    std::array<Vec3, 6> rim{};
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const double angle = 2 * 3.14159265358979 / 6 * (static_cast<double>(k) + random.between(0, 0.3));
      rim[k] = {far * std::cos(angle), far * std::sin(angle), 0};
    }
    Owners owners(screen);
    for (std::size_t k = 0; k < rim.size(); ++k) owners.add({{center, rim[k], rim[(k + 1) % rim.size()]}});
    ASSERT_EQ(owners.pixels_with(1), owners.all()) << "mesh " << i;
  }
}

/// Compares the spans of a triangle with those calculated in a wider type.
template <typename Int, typename Coordinate = Int>
void expect_spans_in(const TextTriangle& t, const Viewport& screen) {
  const ExactGrid grid(screen);
  const std::array<double, 3> z = {t.p[0].z, t.p[1].z, t.p[2].z};
  const auto on_grid =
      grid_triangle<Coordinate>(grid, column_units(grid, t.exact()), row_units(grid, t.exact()));
  const CenterBox box(on_grid, screen.rows, screen.columns);
  const std::vector<Span> expected =
      box.is_empty() ? std::vector<Span>() : spans_of(ExactRows<Int>(on_grid, box, z));
  const std::vector<Span> spans = spans_of(CenterRows(grid, t.exact()));
  ASSERT_EQ(spans.size(), expected.size());
  for (std::size_t k = 0; k < spans.size(); ++k) {
    ASSERT_EQ(spans[k].row, expected[k].row);
    ASSERT_EQ(spans[k].first_column, expected[k].first_column);
    ASSERT_EQ(spans[k].last_column, expected[k].last_column);
    for (const int column : {spans[k].first_column, spans[k].last_column})
      ASSERT_NEAR(spans[k].depth(column), expected[k].depth(column), 0x1p-51);
  }
}

TEST(CoverageCenter, AllWidthsOfNumbersGiveTheSamePixelsAndDepths) {
  RandomNumbers random(3);
  for (const Viewport& screen :
       {decimal_screen(50, 50), decimal_screen(1023, 777), decimal_screen(640, 480, -1.3333333, -1),
        decimal_screen(211, 333, -100000.0000001, -1)}) {
    for (int i = 0; i < 800; ++i) {
      UnitTriangle units{};
      for (auto& vertex : units)
        vertex = {random.whole(-12'000'000, 12'000'000), random.whole(-12'000'000, 12'000'000)};
      if (i % 2 == 0)
        for (std::size_t k = 1; k < 3; ++k)
          units[k] = {units[0][0] + random.whole(-400'000, 400'000),
                      units[0][1] + random.whole(-400'000, 400'000)};
      // Up to 10^8: 64 bits still hold the coordinates, but products need 128.
      const std::int64_t far = i % 4 == 1 ? random.whole(1, 80'000'000) : 1;
      for (auto& vertex : units) vertex = {vertex[0] * far, vertex[1] * far};
      const TextTriangle t =
          triangle_of(units, {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
      expect_spans_in<DoublesInt, Int128>(t, screen);
      expect_spans_in<WideInt>(t, screen);
      if (i % 100 == 0) expect_spans_in<HugeInt>(t, screen);
      if (HasFatalFailure()) FAIL() << "triangle " << i;
    }
  }
}

TEST(CoverageCenter, TheLargestNumbersIn64BitsGiveTheSamePixels) {
  // The limits are 2^44 - 3 units, and no divisor is common to them and to the count of columns or rows.
  constexpr std::int64_t kLimit = 17592186044413;
  const Viewport screen = decimal_screen(65521, 11, -1759218.6044413, -1759218.6044413);
  RandomNumbers random(5);
  for (int i = 0; i < 200; ++i) {
    const auto coordinate = [&] {
      return (random.whole(0, 1) == 0 ? kLimit : -kLimit) / (i % 2 == 0 ? 1 : random.whole(1, 9));
    };
    UnitTriangle units{};
    for (auto& vertex : units) vertex = {coordinate(), coordinate()};
    const TextTriangle t = triangle_of(units, {0.5, 0.25, -1});
    ASSERT_TRUE(narrow_triangle(ExactGrid(screen), t.exact()));
    expect_spans_in<WideInt>(t, screen);
    if (HasFatalFailure()) FAIL() << "triangle " << i;
  }
}

TEST(CoverageCenter, ALowPartFarBelowTheLastDecimalChangesNothing) {
  const auto row_of = [](double low_part) {
    TextTriangle t = triangle_of("-1000000000 -3 0 -1000000000 3 0 1000000000 -3 0");
    t.low_parts[2].x = low_part;
    Owners owners(kEightByEight);
    owners.add(t);
    return owners.picture();
  };
  EXPECT_EQ(row_of(1e-60), row_of(0));
  EXPECT_EQ(row_of(-1e-60), row_of(0));
  EXPECT_NE(row_of(-1e9), row_of(0));
}

TEST(CoverageCenter, AnyFiniteNumbersGiveSpansOnTheScreen) {
  RandomNumbers random(4);
  const auto value = [&] {
    return kAnyNumbers[static_cast<std::size_t>(random.whole(0, static_cast<int>(kAnyNumbers.size()) - 1))];
  };
  for (const double limit : {1.0, 1e-200, 1e200}) {
    const Viewport screen = {5, 4, -limit, -limit, -1, 1};
    const ExactGrid grid(screen);
    for (int i = 0; i < 700; ++i) {
      TextTriangle t;
      for (Vec3& p : t.p) p = {value(), value(), value()};
      expect_on_screen(spans_of(CenterRows(grid, t.exact())), screen);
      ASSERT_FALSE(HasFatalFailure()) << "triangle " << i;
    }
  }
}

TEST(CoverageCenter, TheLargestNumbersGiveTheRightPicture) {
  // x + y <= 0 with the diagonal as right edge, drawn with corners whose differences exceed a double's
  // precision.
  EXPECT_EQ(picture_of("-1.7976931348623157e308 1.7976931348623157e308 0 1.7976931348623157e308 "
                       "-1.7976931348623157e308 0 -1.7976931348623157e308 -1.7976931348623157e308 0"),
            (Picture{
                "........",
                "#.......",
                "##......",
                "###.....",
                "####....",
                "#####...",
                "######..",
                "#######.",
            }));
}

TEST(CoverageCenter, ATriangleFarSmallerThanAPixelOwnsTheCenterInIt) {
  // The center of the middle pixel of an odd number is at 0. The window's limits have many more digits than
  // the triangle.
  const ExactGrid grid({65535, 65535, -1.0 / 3, -1.0 / 3, -1, 1});
  TextTriangle t = triangle_of("-3 -3 0 5 -3 0 -1 7 0");
  t.decimal_marks = 0;
  for (Vec3& p : t.p) p = {p.x * 0x1p-70, p.y * 0x1p-70, p.z};
  const std::vector<Span> spans = spans_of(CenterRows(grid, t.exact()));
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_EQ(spans[0].row, 32767);
  EXPECT_EQ(spans[0].first_column, 32767);
  EXPECT_EQ(spans[0].last_column, 32767);
}

TEST(CoverageCenter, ATinyWorldLooksLikeALargeOne) {
  TextTriangle t = triangle_of("-3.25 -3 0.1 3 -2.125 0.2 0.375 3 0.7");
  const std::vector<Span> expected = spans_of(CenterRows(ExactGrid(kEightByEight), t.exact()));
  t.decimal_marks = 0;
  for (const double scale : {0x1p-600, 0x1p600}) {
    TextTriangle scaled = t;
    for (Vec3& p : scaled.p) p = {p.x * scale, p.y * scale, p.z};
    const std::vector<Span> spans =
        spans_of(CenterRows(ExactGrid({8, 8, -4 * scale, -4 * scale, -1, 1}), scaled.exact()));
    ASSERT_EQ(spans.size(), expected.size());
    for (std::size_t k = 0; k < spans.size(); ++k) {
      EXPECT_EQ(spans[k].first_column, expected[k].first_column);
      EXPECT_EQ(spans[k].last_column, expected[k].last_column);
      EXPECT_NEAR(spans[k].depth(spans[k].first_column), expected[k].depth(expected[k].first_column),
                  0x1p-51);
    }
  }
}

// Depths that cross within a row of many columns: exact depths, evaluated at each pixel, decide which is
// nearest.

/// The triangle visible in each column of a screen one row high; each quad is given by its depths on the left
/// and on the right.
std::vector<int> nearest_in_each_column(int columns, const std::vector<std::array<std::string, 2>>& depths) {
  const Viewport screen = decimal_screen(columns, 1);
  const ExactGrid grid(screen);
  ZBuffer<> buffer(screen);
  for (std::size_t i = 0; i < depths.size(); ++i) {
    const auto& [left, right] = depths[i];
    for (const std::string& half : {joined({"-1 -1", left, "1 -1", right, "1 1", right}),
                                    joined({"-1 -1", left, "1 1", right, "-1 1", left})})
      for (const Span& span : spans_of(CenterRows(grid, triangle_of(half).exact())))
        buffer.draw(span, static_cast<PixelTag>(i + 1));
  }
  std::vector<int> seen;
  buffer.for_each_row([&](const VisibleRow& row) {
    for (const PixelTag tag : row.tags) seen.push_back(static_cast<int>(tag));
  });
  return seen;
}

TEST(CoverageCenter, CrossingPlanesChangePlacesInTheRightColumn) {
  // Equal at x = 0, between columns 4095 and 4096.
  const std::vector<int> seen =
      nearest_in_each_column(8192, {{"-0.75", "0.75"}, {"0.3000001", "-0.3000001"}});
  EXPECT_EQ(std::count(seen.begin(), seen.begin() + 4096, 1), 4096);
  EXPECT_EQ(std::count(seen.begin() + 4096, seen.end(), 2), 4096);
}

TEST(CoverageCenter, PlanesOneDigitApartAreToldApartAndOfEqualsTheFirstIsSeen) {
  const std::vector<int> seen = nearest_in_each_column(
      600, {{"0.2345679", "0.8765432"}, {"0.2345678", "0.8765433"}, {"0.2345678", "0.8765433"}});
  EXPECT_EQ(std::count(seen.begin(), seen.begin() + 300, 2), 300);
  EXPECT_EQ(std::count(seen.begin() + 300, seen.end(), 1), 300);
}

TEST(CoverageCenter, ATriangleOfOneDepthHasJustThatEverywhere) {
  RandomNumbers random(5);
  const ExactGrid grid(decimal_screen(100, 100));
  for (int i = 0; i < 1000; ++i) {
    UnitTriangle units{};
    for (auto& vertex : units)
      vertex = {random.whole(-12'000'000, 12'000'000), random.whole(-12'000'000, 12'000'000)};
    const double z = random.with_exponent(-1070, 1000);
    for (const Span& span : spans_of(CenterRows(grid, triangle_of(units, {z, z, z}).exact())))
      for (int column = span.first_column; column <= span.last_column; ++column)
        ASSERT_EQ(span.depth(column), z);
  }
}

TEST(CoverageCenter, OnTheFinestGridTheFirstColumnIsExact) {
  // That of 256 places in each of 16 samples; the limit has 44 bits and no factor in common with it.
  constexpr std::int64_t kColumns = 65535 * 16 * 256, kLimit = 10'000'000'000'001;
  const ExactGrid grid(decimal_screen(kColumns, 1, -static_cast<double>(kLimit) / 1e7));
  // The center of column i is at (2 i + 1 - kColumns) kLimit / kColumns.
  const auto first_from = [&](std::int64_t x) {
    return static_cast<int>((Int128{x} * kColumns + Int128{kColumns - 1} * kLimit + 2 * kLimit - 1) /
                            (2 * kLimit));
  };
  for (const std::int64_t x : {-kLimit, -kLimit + 37'000, std::int64_t{-4'000'000'000}, std::int64_t{-1},
                               std::int64_t{0}, std::int64_t{1}, std::int64_t{123'456'789'012}}) {
    const std::int64_t right = std::max(x + 1'000'000'000, std::int64_t{4'000'000'000});
    const TextTriangle t = triangle_of(UnitTriangle{{{x, -30'000'000}, {x, 30'000'000}, {right, 0}}});
    const std::optional<Span> span = CenterRows(grid, t.exact()).span(0);
    ASSERT_TRUE(span);
    EXPECT_EQ(span->first_column, first_from(x)) << x;
    EXPECT_EQ(span->last_column, first_from(right) - 1) << x;
  }
}

}  // namespace
}  // namespace pipeline
