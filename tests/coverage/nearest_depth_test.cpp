// The depths of the rule `nearest` against rational arithmetic (GMP): those of the triangle's plane at the
// exact centers of pixels.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/coverage/nearest.h"
#include "tests/numbers/random_numbers.h"
#include "tests/numbers/worst_error.h"

namespace pipeline {
namespace {

// Proved in tests/proofs/.
constexpr double kBoundInDoubles = 0x1p-39;  // nearest_depth.g: between the ends of a row
constexpr double kBoundBeyond = 0x1p-28;     // and beyond them
constexpr double kBoundInPairs = 0x1p-49;    // depth_in_pairs.g

/// A triangle's plane, exactly.
struct ExactPlane {
  explicit ExactPlane(const Triangle& t) : x(t[0].x), y(t[0].y), z(t[0].z) {
    const mpq_class bx = mpq_class(t[1].x) - x, by = mpq_class(t[1].y) - y, bz = mpq_class(t[1].z) - z;
    const mpq_class cx = mpq_class(t[2].x) - x, cy = mpq_class(t[2].y) - y, cz = mpq_class(t[2].z) - z;
    area = bx * cy - cx * by;
    x_rise = bz * cy - cz * by;
    y_rise = bx * cz - cx * bz;
  }
  [[nodiscard]] mpq_class depth(const mpq_class& at_x, const mpq_class& at_y) const {
    return z + ((at_x - x) * x_rise + (at_y - y) * y_rise) / area;
  }
  mpq_class x, y, z, area, x_rise, y_rise;
};

mpq_class center(double limit, int index, int count) {
  return mpq_class(limit) * mpq_class(count - 2 * index - 1, count);
}

/// The largest errors, in parts of the largest |z|.
struct Worst {
  void add(double& worst, double error, double bound) {
    ASSERT_LE(error, bound);
    worst = std::max(worst, error);
  }
  /// For the table of bounds (tests/proofs/README.md).
  void print(const std::string& name) const {
    std::printf("%s: worst 2^%.1f between the ends, 2^%.1f beyond them, 2^%.1f in pairs (%d of %d depths)\n",
                name.c_str(), std::log2(between), std::log2(beyond), std::log2(in_pairs), count_in_pairs,
                count);
  }

  double between = 0;
  double beyond = 0;
  double in_pairs = 0;
  int count_in_pairs = 0;
  int count = 0;
  int wrong_text_count = 0;
};

std::string text_of(double z) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), "%.6f", z);
  return text.data();
}

/// Where a row at `y` meets the triangle's edges: the least and the largest x.
std::pair<mpq_class, mpq_class> ends_of_row(const Triangle& t, const mpq_class& y) {
  std::vector<mpq_class> crossings;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 &from = t[i], &to = t[(i + 1) % 3];
    const mpq_class above = to.y - y, below = y - from.y, height = mpq_class(to.y) - from.y;
    if (height != 0 && above * height >= 0 && below * height >= 0)
      crossings.push_back((from.x * above + to.x * below) / height);
  }
  if (crossings.empty()) return {1, 0};
  return {*std::min_element(crossings.begin(), crossings.end()),
          *std::max_element(crossings.begin(), crossings.end())};
}

/// Adds the errors at the ends and in the middle of every row.
void measure(const Triangle& t, const Viewport& screen, Worst& worst) {
  const ExactPlane plane(t);
  if (plane.area == 0) return;
  const double size = std::max({std::fabs(t[0].z), std::fabs(t[1].z), std::fabs(t[2].z)});
  for_each_span(NearestRows(PixelGrid(screen), t), [&](const Span& span) {
    // Seen edge-on as far as doubles tell, or a row at a corner: the smaller depth of two.
    if (span.depth.slope == 0) return;
    const mpq_class y = center(-screen.bottom, span.row, screen.rows);
    const auto [left, right] = ends_of_row(t, y);
    for (const int column :
         {span.first_column, (span.first_column + span.last_column) / 2, span.last_column}) {
      const mpq_class x = center(screen.left, column, screen.columns), exact = plane.depth(x, y);
      const double z = span.depth(column);
      const double error =
          mpq_class(abs(mpq_class(mpq_class(z) - exact))).get_d() / std::max(size, std::fabs(exact.get_d()));
      if (span.depth.dx == 2) {
        worst.add(worst.in_pairs, error, kBoundInPairs);
        ++worst.count_in_pairs;
      } else if (left <= x && x <= right) {
        worst.add(worst.between, error, kBoundInDoubles);
      } else {
        worst.add(worst.beyond, error, kBoundBeyond);
      }
      ASSERT_FALSE(testing::Test::HasFatalFailure()) << "row " << span.row << ", column " << column;
      ++worst.count;
      if (std::fabs(z) <= 1 && text_of(z) != text_of(exact.get_d())) ++worst.wrong_text_count;
    }
  });
}

/// Vertices up to `reach` away, each near or far; with seven decimals.
Triangle random_triangle(RandomNumbers& random, double reach) {
  const auto coordinate = [&](double most) {
    return std::nearbyint(random.between(-most, most) * 1e7) / 1e7;
  };
  Triangle t;
  for (Vec3& p : t) {
    const double most = random.whole(0, 1) == 0 ? std::min(reach, 1.0) : reach;
    p = {coordinate(most), coordinate(most), coordinate(1)};
  }
  return t;
}

/// Narrow, small, or nearly at z = 0.
Triangle odd_triangle(RandomNumbers& random) {
  Triangle t;
  const double x = random.between(-1, 1), y = random.between(-1, 1),
               size = std::ldexp(1.0, -random.whole(0, 20));
  const double lean = random.between(-2, 2), width = std::ldexp(size, -random.whole(0, 30));
  const double z = random.whole(0, 2) == 0 ? 0 : random.between(-1, 1),
               depth = std::ldexp(1.0, -random.whole(0, 20));
  for (Vec3& p : t) {
    const double up = random.between(-size, size);
    p = {x + up * lean + random.between(-width, width), y + up, z + random.between(-depth, depth)};
  }
  return t;
}

const std::array<Viewport, 4> kDepthScreens = {{{40, 40, -1, -1, -1, 1},
                                                {500, 500, -1, -1, -1, 1},
                                                {97, 61, -1.1, -0.7, -1, 1},
                                                {7, 3, -0.3, -2.6, -1, 1}}};

TEST(NearestDepth, IsWithinItsBoundForVerticesNearAndFar) {
  RandomNumbers random(1);
  for (const double reach : {1.5, 1e3, 1e8, 1e12}) {
    Worst worst;
    for (int i = 0; i < 400; ++i) {
      const Triangle t = random_triangle(random, reach);
      measure(t, kDepthScreens[static_cast<std::size_t>(i) % 4], worst);
      ASSERT_FALSE(HasFatalFailure()) << "triangle " << i << " up to " << reach;
    }
    EXPECT_EQ(worst.wrong_text_count, 0);
    worst.print("vertices up to " + text_of(reach));
  }
}

TEST(NearestDepth, IsWithinItsBoundForNarrowSmallAndFlatTriangles) {
  RandomNumbers random(2);
  Worst worst;
  for (int i = 0; i < 6000; ++i) {
    const Triangle t = odd_triangle(random);
    measure(t, kDepthScreens[static_cast<std::size_t>(i) % 4], worst);
    ASSERT_FALSE(HasFatalFailure()) << "triangle " << i;
  }
  EXPECT_EQ(worst.wrong_text_count, 0);
  worst.print("narrow, small and flat triangles");
  // Both ways of calculation were measured.
  EXPECT_GT(worst.count_in_pairs, 100);
  EXPECT_GT(worst.count - worst.count_in_pairs, 100);
}

TEST(NearestDepth, PixelCentersAreWithin2ToMinus50OfTheHalfWidth) {
  RandomNumbers random(3);
  WorstError worst("pixel center, parts of the half width");
  for (int i = 0; i < 20'000; ++i) {
    const Viewport screen = {random.whole(1, kMaxViewportSize),
                             random.whole(1, 2000),
                             -random.between(0.1, 10),
                             -random.between(0.1, 10),
                             -1,
                             1};
    const int column = random.whole(0, 1) == 0 ? screen.columns - 1 : random.whole(0, screen.columns - 1);
    const int row = random.whole(0, screen.rows - 1);
    const PixelGrid grid(screen);
    const mpq_class x = mpq_class(grid.x_of(column)) - center(screen.left, column, screen.columns);
    const mpq_class y = mpq_class(grid.y_of(row)) - center(-screen.bottom, row, screen.rows);
    for (const double error :
         {std::fabs(x.get_d()) / grid.half_width, std::fabs(y.get_d()) / grid.half_height}) {
      ASSERT_LE(error, 0x1p-50);
      worst.add(error);
    }
  }
}

TEST(NearestDepth, FarVerticesCostNoPrintedDigit) {
  // Calculated from the lowest corner in doubles, the depth was 0.04728254.
  const Triangle t = {{{-0.7904382, 0.2617071, 0.5522601},
                       {-0.8525514, 0.5740181, -0.6020556},
                       {20906619.6860820, -73130341.3006560, -0.7223717}}};
  const NearestRows rows(PixelGrid({40, 40, -1, -1, -1, 1}), t);
  const auto span = rows.span(39);
  ASSERT_TRUE(span && span->first_column <= 11 && 11 <= span->last_column);
  EXPECT_NEAR(span->depth(11), 0.04728274, 5e-9);
}

}  // namespace
}  // namespace pipeline
