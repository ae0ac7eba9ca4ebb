// The kernels that compute the spans of many triangles, against the coverage rules, triangle by triangle.

#include "libpipeline/coverage/exact_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "libpipeline/coverage/rules.h"
#include "tests/numbers/random_numbers.h"
#include "tests/numbers/testable_targets.h"
#include "tests/sanitizer_rounds.h"

namespace pipeline {
namespace {

/// Every claim is tested with every kernel that this processor can run.
class CoverageKernelTest : public testing::TestWithParam<std::size_t> {};

Viewport screen_of(int columns, int rows, double left, double bottom, bool is_decimal) {
  Viewport screen{columns, rows, left, bottom};
  screen.left_is_decimal = screen.bottom_is_decimal = is_decimal;
  return screen;
}

/// A triangle and the data that its ExactTriangle refers to.
struct Source {
  Triangle p_ndc;
  Triangle low_parts;
  std::uint16_t decimal_marks;
};

/// A property common to all vertices of a triangle, which makes them ordinary, or unusual in one way.
enum class Coordinates {
  decimals,
  pixel_centers,
  lines,
  off_the_screen,
  far_away,
  any_doubles,
  huge_differences,
  flat,
  kCount
};

Vec3 vertex_of(Coordinates family, const Viewport& screen, const Vec3& middle, double pixels,
               RandomNumbers& random) {
  const PixelGrid grid(screen);
  const auto near = [&](double center, double pixel) {
    return std::nearbyint((center + random.between(-pixels, pixels) * pixel) * 1e7) / 1e7;
  };
  switch (family) {
    case Coordinates::pixel_centers:  // or on the lines between them
      return {grid.x_of(random.whole(-2, 2 * screen.columns)) / 2,
              grid.top_y - random.whole(0, 2 * screen.rows) * grid.dy / 2, random.between(-1, 1)};
    case Coordinates::lines:  // along a row, or a column, or in a point
      return {random.whole(0, 1) * 0.25, random.whole(0, 1) * 0.25, random.whole(0, 1) * 0.25};
    case Coordinates::far_away:
      return {random.with_exponent(0, 60), random.with_exponent(0, 60), random.with_exponent(-20, 20)};
    case Coordinates::any_doubles:
      return {random.any_double(), random.any_double(), random.any_double()};
    case Coordinates::huge_differences: {
      constexpr double kLargest = std::numeric_limits<double>::max();
      const auto one_of = [&](const std::array<double, 5>& values) {
        return values[static_cast<std::size_t>(random.whole(0, 4))];
      };
      return {one_of({-kLargest, kLargest, 0, -0.0, 0.1}), one_of({-kLargest, kLargest, 0, -0.5, 0.5}),
              one_of({-kLargest, kLargest, 0, -0.0, 5e-324})};
    }
    case Coordinates::off_the_screen: {  // small ones
      const auto zero_or_one = static_cast<double>(random.whole(0, 1));
      return {near(middle.x, grid.dx), near(middle.y, grid.dy),
              random.whole(0, 1) == 0 ? zero_or_one : -zero_or_one};
    }
    case Coordinates::flat:
      return {near(middle.x, grid.dx), near(middle.y, grid.dy), middle.z};
    case Coordinates::decimals:
    case Coordinates::kCount:
      break;
  }
  return {near(middle.x, grid.dx), near(middle.y, grid.dy), near(middle.z, 0.01)};
}

Source random_source(const Viewport& screen, RandomNumbers& random) {
  // Half of them decimals, so that four in a row are frequent.
  const Coordinates family =
      random.whole(0, 1) == 0
          ? Coordinates::decimals
          : static_cast<Coordinates>(random.whole(0, static_cast<int>(Coordinates::kCount) - 1));
  const double pixels = std::array{0.7, 3.0, 20.0, 1.5 * screen.columns}[random.bits() % 4];
  Vec3 middle = {random.between(-1.1, 1.1) * -screen.left, random.between(-1.1, 1.1) * -screen.bottom,
                 random.between(-1, 1)};
  if (family == Coordinates::off_the_screen) middle.x = random.with_exponent(0, 26);
  Source source{};
  for (Vec3& vertex : source.p_ndc) vertex = vertex_of(family, screen, middle, pixels, random);
  if (random.whole(0, 9) == 0) source.p_ndc[1].y = source.p_ndc[0].y;
  if (random.whole(0, 9) == 0) source.p_ndc[2] = source.p_ndc[static_cast<std::size_t>(random.whole(0, 1))];
  source.decimal_marks = random.whole(0, 5) == 0 ? static_cast<std::uint16_t>(random.whole(0, 0777)) : 0777;
  return source;
}

/// All members of a span, bit by bit.
std::array<std::uint64_t, 9> bits_of(const TaggedSpan& span) {
  const auto& [row, first, last, depth] = span.span;
  const auto bits = [](double part) { return std::bit_cast<std::uint64_t>(part); };
  return {static_cast<std::uint64_t>(row),
          static_cast<std::uint64_t>(first),
          static_cast<std::uint64_t>(last),
          bits(depth.left_x),
          bits(depth.dx),
          bits(depth.x0),
          bits(depth.z0),
          bits(depth.slope),
          span.tag};
}

template <typename Coverage, typename Kernel>
void expect_the_spans_of_the_rule(Kernel kernel) {
  RandomNumbers random(11);
  for (const Viewport& screen :
       {screen_of(500, 500, -1, -1, true), screen_of(1920, 1080, -1.6, -0.9, true),
        screen_of(7, 5, -1, -1, true), screen_of(3, 2000, -1, -0.3333333, true),
        screen_of(65535, 11, -1, -1, true), screen_of(100, 100, -0.1, -1.0 / 3, false),
        screen_of(100, 100, -1e15, -1e-7, true), screen_of(100, 100, -1e15, -1e-9, false)}) {
    Coverage rule(screen);
    rule.kernel = kernel;
    int span_count = 0;
    for (int i = 0; i < sanitizer_rounds(500); ++i) {
      std::vector<Source> sources(static_cast<std::size_t>(random.whole(0, 11)));
      std::vector<TaggedTriangle> triangles;
      const bool are_doubles = random.whole(0, 3) == 0;  // so that four in a row are frequent, too
      for (Source& source : sources) {
        source = random_source(screen, random);
        if (are_doubles)
          source.decimal_marks =
              random.whole(0, 3) == 0 ? static_cast<std::uint16_t>(random.whole(0, 0776)) : 0;
        triangles.push_back({{source.p_ndc, &source.low_parts, source.decimal_marks},
                             static_cast<PixelTag>(triangles.size())});
      }
      RowRange rows = {random.whole(0, screen.rows - 1), screen.rows};
      if (random.whole(0, 1) == 0) rows.end = random.whole(rows.first, screen.rows);
      if (random.whole(0, 9) == 0) rows = RowRange();
      const int row_count = std::min(rows.end, screen.rows) - rows.first;

      std::vector<TaggedSpan> expected;
      for (const auto& [triangle, tag] : triangles)
        for_each_span(rule.rows(triangle), rows, [&, of = tag](const Span& span) {
          expected.push_back({span, of});
        });
      std::vector<TaggedSpan> found(triangles.size() * static_cast<std::size_t>(row_count));
      const TaggedSpan* const end = rule.spans(triangles, rows, found.data());

      found.resize(static_cast<std::size_t>(end - found.data()));
      ASSERT_EQ(found.size(), expected.size()) << "round " << i;
      for (std::size_t k = 0; k < found.size(); ++k) ASSERT_EQ(bits_of(found[k]), bits_of(expected[k]));
      span_count += static_cast<int>(found.size());
    }
    EXPECT_GT(span_count, sanitizer_rounds(1000));
  }
}

TEST_P(CoverageKernelTest, NearestSpansAreThoseOfTheRule) {
  expect_the_spans_of_the_rule<NearestCoverage>(kNearestKernels[GetParam()]);
}

TEST_P(CoverageKernelTest, CenterSpansAreThoseOfTheRule) {
  expect_the_spans_of_the_rule<CenterCoverage>(kCenterKernels[GetParam()]);
}

TEST_P(CoverageKernelTest, TheSmallestTrianglesOwnACenterAtTheirTopLeftCornerAlone) {
  const Viewport screen = screen_of(10, 10, -1, -1, true);
  CenterCoverage rule(screen);
  rule.kernel = kCenterKernels[GetParam()];
  // From the center of column 5 and row 4, two sides one unit of the last decimal long.
  constexpr double kLess = 0.0999999, kCenter = 0.1, kMore = 0.1000001;
  const Vec3 corner = {kCenter, kCenter, 0}, left = {kLess, kCenter, 0}, right = {kMore, kCenter, 0},
             below = {kCenter, kLess, 0}, above = {kCenter, kMore, 0};
  const std::array<Triangle, 8> triangles = {Triangle{corner, right, below}, Triangle{corner, below, left},
                                             Triangle{corner, left, above},  Triangle{corner, above, right},
                                             Triangle{below, right, corner}, Triangle{left, below, corner},
                                             Triangle{above, left, corner},  Triangle{right, above, corner}};
  std::vector<TaggedTriangle> tagged;
  for (const Triangle& p_ndc : triangles)
    tagged.push_back({{p_ndc, nullptr, 0777}, static_cast<PixelTag>(tagged.size())});
  std::vector<TaggedSpan> spans(triangles.size() * 10);
  spans.resize(static_cast<std::size_t>(rule.spans(tagged, {0, 10}, spans.data()) - spans.data()));
  ASSERT_EQ(spans.size(), 2u);
  for (const auto& [span, tag] : spans) {
    EXPECT_EQ(span.row, 4);
    EXPECT_EQ(span.first_column, 5);
    EXPECT_EQ(span.last_column, 5);
  }
  EXPECT_EQ(spans[0].tag, 0u);
  EXPECT_EQ(spans[1].tag, 4u);
}

// In every room, the same targets are left out.
TEST(Kernels, AreCompiledForEveryProcessor) {
  const auto is_family = [](std::string_view target) { return target == "avx2"; };
  const auto avx2 = static_cast<std::size_t>(std::ranges::find_if(kTargets, is_family) - kTargets.begin());
  if (kNearestKernels[avx2] == nullptr) GTEST_SKIP() << "not a processor with several kinds of vectors";
  if (kNearestKernels[avx2 - 1] == nullptr)
    GTEST_SKIP() << "the kernels for sse4 and avx512 are left out (PIPELINE_ALL_KERNELS)";
  for (std::size_t target = avx2 - 1; target <= avx2; ++target) EXPECT_NE(kCenterKernels[target], nullptr);
}

INSTANTIATE_TEST_SUITE_P(Kernels, CoverageKernelTest, testing::ValuesIn(testable_targets(kNearestKernels)),
                         name_of_target);

}  // namespace
}  // namespace pipeline
