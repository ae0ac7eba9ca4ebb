#include "libpipeline/numbers/double_double.h"

#include <gtest/gtest.h>

#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"
#include "tests/numbers/worst_error.h"

namespace pipeline {
namespace {

// u^2 of the bounds: u = 2^-53.
constexpr double kUnitSquared = 0x1p-106;

using Exact1024 = Real<1024>;

/// Checks |computed - exact| <= units u^2 |exact| on random operands whose results neither over- nor
/// underflow.
template <typename Computed, typename Truth>
void expect_within(double units, Computed computed, Truth truth, std::uint64_t seed, int count) {
  RandomNumbers random(seed);
  WorstError worst(testing::UnitTest::GetInstance()->current_test_info()->name());
  for (int i = 0; i < count; ++i) {
    const DoubleDouble a = random.double_double(-100, 100);
    DoubleDouble b = random.double_double(-100, 100);
    // Cancellation of the high parts alone, or of all but the last bits.
    if (i % 4 == 1) b = fast_two_sum(-a.hi, random.double_double(-160, -155).hi * a.hi);
    if (i % 4 == 2) b = -a + random.double_double(-100, 0) * (a.hi * 0x1p-60);
    const Exact1024 exact = truth(a, b);
    const Exact1024 error = abs(Exact1024(computed(a, b)) - exact);
    ASSERT_LE(error, abs(exact) * Exact1024(units * kUnitSquared) * Exact1024(1 + 0x1p-40))
        << std::hexfloat << a.hi << " + " << a.lo << ", " << b.hi << " + " << b.lo;
    if (exact.sign() != 0) worst.add((error / abs(exact)).nearest_double());
  }
}

TEST(DoubleDouble, TwoSumLosesNothing) {
  RandomNumbers random(1);
  for (int i = 0; i < 100'000; ++i) {
    const double a = random.with_exponent(-200, 200);
    const double b = random.with_exponent(-200, 200);
    ASSERT_EQ(Exact1024(two_sum(a, b)), Exact1024(a) + Exact1024(b)) << std::hexfloat << a << ", " << b;
  }
}

TEST(DoubleDouble, TwoProductLosesNothing) {
  RandomNumbers random(2);
  for (int i = 0; i < 100'000; ++i) {
    const double a = random.with_exponent(-450, 450);
    const double b = random.with_exponent(-450, 450);
    ASSERT_EQ(Exact1024(two_product(a, b)), Exact1024(a) * Exact1024(b)) << std::hexfloat << a << ", " << b;
  }
}

TEST(DoubleDouble, SumIsWithinThreeUnits) {
  expect_within(
      3, [](auto a, auto b) { return a + b; }, [](Exact1024 a, Exact1024 b) { return a + b; }, 3, 100'000);
}

TEST(DoubleDouble, ProductIsWithinFiveUnits) {
  expect_within(
      5, [](auto a, auto b) { return a * b; }, [](Exact1024 a, Exact1024 b) { return a * b; }, 4, 100'000);
}

TEST(DoubleDouble, ProductWithADoubleIsWithinTwoUnits) {
  const auto computed = [](DoubleDouble a, DoubleDouble b) { return a * b.hi; };
  const auto truth = [](DoubleDouble a, DoubleDouble b) { return Exact1024(a) * Exact1024(b.hi); };
  expect_within(2, computed, truth, 5, 100'000);
}

TEST(DoubleDouble, QuotientIsWithinSixteenUnits) {
  expect_within(
      16, [](auto a, auto b) { return a / b; }, [](Exact1024 a, Exact1024 b) { return a / b; }, 6, 100'000);
}

TEST(DoubleDouble, RootIsWithinFourUnits) {
  const auto positive = [](DoubleDouble a) { return a.hi < 0 ? -a : a; };
  const auto computed = [&](DoubleDouble a, DoubleDouble) { return sqrt(positive(a)); };
  const auto truth = [&](DoubleDouble a, DoubleDouble) { return sqrt(Exact1024(positive(a))); };
  expect_within(4, computed, truth, 7, 100'000);
}

TEST(DoubleDouble, RootOfZeroIsZero) {
  EXPECT_EQ(sqrt(DoubleDouble{0, 0}), (DoubleDouble{0, 0}));
}

TEST(DoubleDouble, ResultsAreNormalized) {
  RandomNumbers random(8);
  for (int i = 0; i < 100'000; ++i) {
    const DoubleDouble a = random.double_double(-100, 100);
    const DoubleDouble b = random.double_double(-100, 100);
    for (const DoubleDouble result : {a + b, a - b, a * b, a * b.hi, a / b})
      ASSERT_EQ(result.hi, result.hi + result.lo)
          << std::hexfloat << a.hi << " + " << a.lo << ", " << b.hi << " + " << b.lo;
  }
}

TEST(DoubleDouble, LongSumsProductsAndQuotientsAreWithinTheirUnits) {
  expect_within(
      3, [](auto a, auto b) { return a + b; }, [](Exact1024 a, Exact1024 b) { return a + b; }, 9, 5'000'000);
  expect_within(
      5, [](auto a, auto b) { return a * b; }, [](Exact1024 a, Exact1024 b) { return a * b; }, 10, 5'000'000);
  expect_within(
      16, [](auto a, auto b) { return a / b; }, [](Exact1024 a, Exact1024 b) { return a / b; }, 11,
      5'000'000);
}

}  // namespace
}  // namespace pipeline
