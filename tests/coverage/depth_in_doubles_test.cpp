// Depths as weighted means in doubles, against rational arithmetic (GMP).

#include "libpipeline/coverage/triangle_depth.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "tests/numbers/random_numbers.h"
#include "tests/numbers/worst_error.h"

namespace pipeline {
namespace {

mpz_class whole(std::int64_t value) {
  return mpz_class(static_cast<double>(value));  // below 2^53
}

/// A row of pixels in a triangle: the weights of b and c at the first one, and their increments from each to
/// the next. No weight, including a's, is below 0.
struct Row {
  std::int64_t total;
  std::int64_t b;
  std::int64_t c;
  std::int64_t b_step;
  std::int64_t c_step;
  int pixel_count;
};

/// Rows that end at random points of the triangle, often on an edge or in a corner.
Row random_row(RandomNumbers& random) {
  const std::int64_t most = DepthInDoubles::kMaxWeight >> random.whole(0, 40);
  const auto below = [&](std::int64_t end) {
    return random.whole(0, 3) == 0
               ? 0
               : static_cast<std::int64_t>(random.bits() % static_cast<std::uint64_t>(end));
  };
  Row row{};
  row.pixel_count = 1 + random.whole(0, 3) * random.whole(0, 300);
  const std::int64_t gaps = std::max(row.pixel_count - 1, 1);
  // Each weight at the ends, in steps: multiples of `gaps` apart.
  const std::int64_t first_b = below(most / 3 + 1), first_c = below(most / 3 + 1);
  const std::int64_t last_b = first_b % gaps + gaps * below(most / 3 / gaps + 1);
  const std::int64_t last_c = first_c % gaps + gaps * below(most / 3 / gaps + 1);
  row.b = first_b;
  row.c = first_c;
  row.b_step = (last_b - first_b) / gaps;
  row.c_step = (last_c - first_c) / gaps;
  row.total = std::max({first_b + first_c, last_b + last_c, std::int64_t{1}}) + below(most / 4 + 1);
  return row;
}

std::array<double, 3> random_depths(RandomNumbers& random) {
  const double base = random.between(-1, 1);
  const int family = random.whole(0, 3);
  std::array<double, 3> z{};
  for (double& depth : z) {
    if (family == 0) depth = random.between(-1, 1);
    if (family == 1) depth = random.with_exponent(-80, 40);
    if (family == 2) depth = base * (1 + random.whole(-2, 2) * 0x1p-52);
    if (family == 3) depth = random.bits() % 2 == 0 ? 1 : -1 + random.between(0, 1e-3);
  }
  return z;
}

TEST(DepthInDoubles, IsWithinItsBoundAlongEveryRow) {
  RandomNumbers random(1);
  double largest_error = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Row row = random_row(random);
    const std::array<double, 3> z = random_depths(random);
    ASSERT_TRUE(DepthInDoubles::can_take(z, row.total, row.b_step, row.c_step));
    const DepthInDoubles depth_in_doubles(z, static_cast<double>(row.total), static_cast<double>(row.b_step),
                                          static_cast<double>(row.c_step));
    const int first = random.whole(0, 60'000), gaps = row.pixel_count - 1, last = first + gaps;
    const SpanDepth depth =
        depth_in_doubles.along(first, last, static_cast<double>(2 * row.b + gaps * row.b_step),
                               static_cast<double>(2 * row.c + gaps * row.c_step));

    const mpq_class size = std::max({std::fabs(z[0]), std::fabs(z[1]), std::fabs(z[2])});
    for (const int column : {first, (first + last) / 2, last}) {
      const mpz_class b = whole(row.b + (column - first) * row.b_step);
      const mpz_class c = whole(row.c + (column - first) * row.c_step);
      const mpz_class a = whole(row.total) - b - c;
      ASSERT_TRUE(a >= 0 && b >= 0 && c >= 0) << "the test's own row";
      const mpq_class exact =
          (a * mpq_class(z[0]) + b * mpq_class(z[1]) + c * mpq_class(z[2])) / whole(row.total);
      const mpq_class error = abs(mpq_class(depth(column)) - exact);
      ASSERT_TRUE(error <= size * mpq_class(6.5 * 0x1p-53)) << "row " << i << ", column " << column;
      largest_error = std::max(largest_error, mpq_class(error / size).get_d());
    }
  }
  // The bound is realistic: errors reach a third of it.
  EXPECT_GT(largest_error, 6.5 / 3 * 0x1p-53);
  WorstError("depth under center in doubles, parts of the largest |z|").add(largest_error);
}

TEST(DepthInDoubles, OneDepthIsThatDepthEverywhere) {
  for (const double z : {0.1, -0.0, 5e-324, 1e308}) {
    ASSERT_TRUE(DepthInDoubles::can_take({z, z, z}, 7, 3, -2));
    const SpanDepth depth = DepthInDoubles({z, z, z}, 7, 3, -2).along(10, 11, 5, 2);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(depth(10)), std::bit_cast<std::uint64_t>(z));
    EXPECT_EQ(depth(11), z);
  }
}

TEST(DepthInDoubles, ZeroHasNoSign) {
  // At b: 2 * -0.0 and two zero weights, one of them times -1.
  const SpanDepth depth = DepthInDoubles({-1, -0.0, -0.0}, 1, 0, 0).along(3, 3, 2, 0);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(depth.z0), 0u);
  EXPECT_EQ(std::bit_cast<std::uint64_t>(depth.slope), 0u);
}

TEST(DepthInDoubles, TakesWhatDoublesHold) {
  constexpr std::int64_t kMost = std::int64_t{1} << 50;
  EXPECT_TRUE(DepthInDoubles::can_take({0, 1, 2}, kMost, kMost, -kMost));
  EXPECT_FALSE(DepthInDoubles::can_take({0, 1, 2}, kMost + 1, 0, 0));
  EXPECT_FALSE(DepthInDoubles::can_take({0, 1, 2}, 1, kMost + 1, 0));
  EXPECT_FALSE(DepthInDoubles::can_take({0, 1, 2}, 1, 0, -kMost - 1));
  EXPECT_FALSE(DepthInDoubles::can_take({1e-300, 0, 0}, 1, 0, 0))
      << "products with weights would lose digits";
  EXPECT_FALSE(DepthInDoubles::can_take({1e300, 0, 0}, 1, 0, 0)) << "products with weights would be infinite";
}

}  // namespace
}  // namespace pipeline
