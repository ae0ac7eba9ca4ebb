// The errors of coordinates as the vertex kernels calculate them, before any rounding test, against MPFR.

#include <gtest/gtest.h>

#include <array>

#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"
#include "tests/numbers/worst_error.h"

// Every kernel does the same operations in each lane.
#define PIPELINE_TARGETS HWY_SCALAR
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/vertex/coordinate_error_test.cpp"
#include "libpipeline/vertex/vertex_lanes.h"

namespace pipeline {
namespace {

using namespace N_SCALAR;
using Exact2048 = Real<2048>;

/// A row of a matrix, the origin and a vertex; often most of it cancels.
struct Source {
  explicit Source(RandomNumbers& random) {
    for (Ball& entry : row) entry = Ball::with_error(random.double_double(-4, 4), 0);
    for (double& x : origin) x = random.with_exponent(-4, 4);
    for (double& x : p) x = random.with_exponent(-4, 4);
    if (random.bits() % 2 == 0) {
      const Exact2048 rest = image() - midpoint<2048>(row[3]);
      const double high = -rest.nearest_double();
      row[3] = Ball::with_error(fast_two_sum(high, random.with_exponent(-60, -54) * high), 0);
    }
  }
  [[nodiscard]] Exact2048 term(std::size_t i) const {
    return i == 3 ? midpoint<2048>(row[3])
                  : midpoint<2048>(row[i]) * (Exact2048(p[i]) - Exact2048(origin[i]));
  }
  [[nodiscard]] Exact2048 image() const { return term(0) + term(1) + term(2) + term(3); }
  [[nodiscard]] Exact2048 size() const { return abs(term(0)) + abs(term(1)) + abs(term(2)) + abs(term(3)); }
  [[nodiscard]] std::array<Coefficient, 4> coefficients() const {
    return {Coefficient(row[0]), Coefficient(row[1]), Coefficient(row[2]), Coefficient(row[3])};
  }

  std::array<Ball, 4> row;
  std::array<double, 3> origin{};
  std::array<double, 3> p{};
};

TEST(CoordinateError, InDoublesIsWithinTheCalculatedBound) {
  RandomNumbers random(1);
  WorstError worst("coordinate in doubles, parts of the terms");
  for (int i = 0; i < 50'000; ++i) {
    const Source source(random);
    const auto& [x, y, z] = source.p;
    const auto& [ox, oy, oz] = source.origin;
    const Estimate e = image_in_doubles(source.coefficients(), all(Vec3{x - ox, y - oy, z - oz}));
    const Exact2048 error = abs(Exact2048(e.value.raw) - source.image());
    ASSERT_LE(error, Exact2048(e.error.raw)) << i;
    worst.add((error / source.size()).nearest_double());
  }
}

TEST(CoordinateError, InPairsIsWithin2ToMinus98OfTheTerms) {
  RandomNumbers random(2);
  WorstError worst("coordinate in pairs, parts of the terms");
  for (int i = 0; i < 50'000; ++i) {
    const Source source(random);
    const auto& [x, y, z] = source.p;
    const auto& [ox, oy, oz] = source.origin;
    const PairEstimate e =
        image_in_pairs(source.coefficients(),
                       {two_sum(all(x), all(-ox)), two_sum(all(y), all(-oy)), two_sum(all(z), all(-oz))});
    const Exact2048 error = abs(Exact2048(DoubleDouble{e.high.raw, e.low.raw}) - source.image());
    ASSERT_LE(error, source.size() * Exact2048(0x1p-98)) << i;
    ASSERT_LE(error, Exact2048(e.error.raw)) << i;
    worst.add((error / source.size()).nearest_double());
  }
}

}  // namespace
}  // namespace pipeline
