#include "libpipeline/numbers/ball.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"

namespace pipeline {

/// For gtest's messages.
void PrintTo(const Ball& ball, std::ostream* out) {
  const auto [hi, lo] = ball.value();
  *out << std::hexfloat << "(" << hi << " + " << lo << " +- " << ball.error() << ") * 2^" << ball.exponent();
}

namespace {

// Holds the sum of any two doubles.
using Exact2304 = Real<2304>;

constexpr double kSmallest = std::numeric_limits<double>::denorm_min();
constexpr double kLargest = std::numeric_limits<double>::max();

/// Balls as they occur in the pipeline and far beyond: exact doubles of any size, wide and narrow balls,
/// balls around 0, numbers outside a double's range, double-doubles whose parts are far apart.
Ball any_ball(RandomNumbers& random) {
  switch (random.bits() % 8) {
    case 0:
      return random.any_double();
    case 1:
      return random.with_exponent(-3, 3);
    case 2:
      return Ball(random.with_exponent(-400, 400)) + Ball(random.with_exponent(-400, 400));
    case 3:
      return Ball(random.any_double()) * random.any_double() * random.any_double();
    case 4:  // 0 may lie in it
      return Ball::with_error(random.double_double(-20, 20), std::fabs(random.with_exponent(-25, 25)));
    case 5: {
      const Ball factor = Ball(random.any_double()) * Ball(std::ldexp(1.0, random.whole(-1000, 1000)));
      return Ball::with_error(random.double_double(-2, 2), std::fabs(random.with_exponent(-120, 4))) * factor;
    }
    default: {
      const DoubleDouble value = random.double_double(-290, 290);
      return Ball::with_error(value, std::ldexp(std::fabs(value.hi), random.whole(-110, -1)));
    }
  }
}

/// A ball close to `ball`, so that their difference cancels; half of the time negated.
Ball near_to(const Ball& ball, RandomNumbers& random) {
  const Ball factor = Ball(1) + Ball(random.with_exponent(-110, -40));
  const Ball near = random.bits() % 4 == 0 ? ball : ball * factor;
  return random.bits() % 2 == 0 ? near : -near;
}

/// Some members of a ball: the midpoint, both ends, one between.
std::array<Exact2304, 4> members(const Ball& ball, RandomNumbers& random) {
  const Exact2304 middle = midpoint<2304>(ball);
  const Exact2304 error = radius<2304>(ball);
  return {middle, middle - error, middle + error, middle + error * Exact2304(random.between(-1, 1))};
}

/// The invariants of every ball.
void expect_sound(const Ball& ball) {
  const auto [hi, lo] = ball.value();
  const double leading = std::max(std::fabs(hi), ball.error());
  ASSERT_TRUE(std::isfinite(hi) && std::isfinite(lo) && std::isfinite(ball.error()));
  ASSERT_GE(ball.error(), 0);
  ASSERT_EQ(hi, hi + lo);
  if (leading == 0) {
    ASSERT_EQ(ball.exponent(), 0);
    return;
  }
  ASSERT_GE(leading, 0x1p-300);
  ASSERT_LT(leading, 0x1p301);
  if (ball.exponent() == 0) return;
  ASSERT_GT(std::llabs(ball.exponent() + std::ilogb(leading)), 299);
}

template <typename Operation>
void expect_image(const Ball& image, const Ball& a, const Ball& b, RandomNumbers& random, Operation exact) {
  expect_sound(image);
  if (testing::Test::HasFatalFailure()) return;
  for (const Exact2304& x : members(a, random))
    for (const Exact2304& y : members(b, random))
      ASSERT_TRUE(contains(image, exact(x, y))) << x << ", " << y << "\nin " << testing::PrintToString(image);
}

/// Checks that `compute` of two balls contains `exact` of any two of their members.
template <typename Operation, typename Computed>
void expect_containment(Computed compute, Operation exact, bool divides, std::uint64_t seed, int count) {
  RandomNumbers random(seed);
  for (int i = 0; i < count; ++i) {
    const Ball a = any_ball(random);
    const Ball b = i % 3 == 0 ? near_to(a, random) : any_ball(random);
    if (divides && b.sign() == 0) continue;
    expect_image(compute(a, b), a, b, random, exact);
    if (testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << "a = " << testing::PrintToString(a) << "\nb = " << testing::PrintToString(b);
      return;
    }
  }
}

const auto kAdd = [](const auto& a, const auto& b) { return a + b; };
const auto kSubtract = [](const auto& a, const auto& b) { return a - b; };
const auto kMultiply = [](const auto& a, const auto& b) { return a * b; };
const auto kDivide = [](const auto& a, const auto& b) { return a / b; };

void expect_roots_contained(std::uint64_t seed, int count) {
  RandomNumbers random(seed);
  for (int i = 0; i < count; ++i) {
    Ball a = any_ball(random);
    if (a.sign() < 0) a = -a;
    const Ball root = sqrt(a);
    expect_sound(root);
    for (const Exact2304& x : members(a, random)) {
      if (x.sign() < 0) continue;
      ASSERT_TRUE(contains(root, sqrt(x))) << testing::PrintToString(a) << "\n"
                                           << testing::PrintToString(root);
    }
  }
}

TEST(Ball, SumsProductsAndRootsContainThoseOfAllMembers) {
  expect_containment(kAdd, kAdd, false, 1, 10'000);
  expect_containment(kSubtract, kSubtract, false, 2, 10'000);
  expect_containment(kMultiply, kMultiply, false, 3, 5'000);
  expect_containment(kDivide, kDivide, true, 4, 3'000);
  expect_roots_contained(5, 10'000);
}

TEST(Ball, LongSumsProductsAndRootsContainThoseOfAllMembers) {
  expect_containment(kAdd, kAdd, false, 101, 2'000'000);
  expect_containment(kSubtract, kSubtract, false, 102, 1'000'000);
  expect_containment(kMultiply, kMultiply, false, 103, 1'000'000);
  expect_containment(kDivide, kDivide, true, 104, 500'000);
  expect_roots_contained(105, 1'000'000);
}

TEST(Ball, IsAnyDoubleExactly) {
  RandomNumbers random(6);
  for (int i = 0; i < 100'000; ++i) {
    const double value = random.any_double();
    const Ball ball = value;
    ASSERT_TRUE(ball.is_exact());
    ASSERT_EQ(midpoint<2304>(ball), Exact2304(value)) << std::hexfloat << value;
    ASSERT_EQ(ball.nearest_double(), value);
  }
}

TEST(Ball, SumOfTwoDoublesIsExactWithinSixHundredBinaryPlaces) {
  RandomNumbers random(7);
  for (int i = 0; i < 100'000; ++i) {
    const double a = random.any_double();
    const int exponent = std::max(-1022, std::min(1023, std::ilogb(a) + random.whole(-598, 598)));
    const double b = random.with_exponent(exponent, exponent);
    const Ball sum = Ball(a) + Ball(b);
    ASSERT_TRUE(sum.is_exact()) << std::hexfloat << a << ", " << b;
    ASSERT_EQ(midpoint<2304>(sum), Exact2304(a) + Exact2304(b)) << std::hexfloat << a << ", " << b;
  }
}

TEST(Ball, DifferenceOfANumberAndItselfIsExactlyZero) {
  EXPECT_TRUE((Ball(1e300) - Ball(1e300)).is_exact_zero());
  EXPECT_TRUE((Ball(kSmallest) - Ball(kSmallest)).is_exact_zero());
  EXPECT_TRUE((Ball(0.1) - Ball(0.1)).is_exact_zero());
  EXPECT_EQ(Ball(1e300) - Ball(1e300), Ball());
  EXPECT_EQ(Ball() * Ball(1e300) * Ball(1e300), Ball());
  EXPECT_EQ(Ball() / Ball(0x1p-1000), Ball());
}

TEST(Ball, ZeroChangesNothing) {
  const Ball exact = Ball(0.1) * Ball(0.1), wide = Ball(1) / Ball(3), huge = Ball(1e300) * Ball(1e300);
  for (const Ball& ball : {exact, wide, huge}) {
    EXPECT_EQ(ball + Ball(), ball);
    EXPECT_EQ(Ball() + ball, ball);
    EXPECT_EQ(ball * Ball(), Ball());
    EXPECT_EQ(Ball() * ball, Ball());
  }
}

TEST(Ball, ProductOfTwoDoublesIsExact) {
  RandomNumbers random(8);
  for (int i = 0; i < 100'000; ++i) {
    const double a = random.any_double();
    const double b = random.any_double();
    const Ball product = Ball(a) * Ball(b);
    ASSERT_TRUE(product.is_exact()) << std::hexfloat << a << ", " << b;
    ASSERT_EQ(midpoint<2304>(product), Exact2304(a) * Exact2304(b)) << std::hexfloat << a << ", " << b;
  }
}

TEST(Ball, QuotientThatIsADoubleIsExact) {
  RandomNumbers random(9);
  for (int i = 0; i < 100'000; ++i) {
    const double quotient = std::ldexp(random.whole(1, 1 << 26), random.whole(-850, 850));
    const double b = std::ldexp(random.whole(1, 1 << 26), random.whole(-90, 90));
    const Ball result = Ball(quotient * b) / Ball(b);
    ASSERT_TRUE(result.is_exact()) << std::hexfloat << quotient << ", " << b;
    ASSERT_EQ(midpoint<2304>(result), Exact2304(quotient));
  }
  EXPECT_FALSE((Ball(1) / Ball(3)).is_exact());
}

TEST(Ball, RootOfASquareIsExact) {
  RandomNumbers random(10);
  for (int i = 0; i < 100'000; ++i) {
    const double root = std::ldexp(random.whole(1, 1 << 26), random.whole(-990, 990));
    const Ball result = sqrt(Ball(root) * Ball(root));
    ASSERT_TRUE(result.is_exact()) << std::hexfloat << root;
    ASSERT_EQ(midpoint<2304>(result), Exact2304(root)) << std::hexfloat << root;
  }
}

TEST(Ball, RootKnowsWhetherItIsExact) {
  const Ball all_bits = Ball(1 + 0x1p-52);
  EXPECT_TRUE(sqrt(all_bits * all_bits).is_exact());
  EXPECT_FALSE(sqrt(Ball(2)).is_exact());
  EXPECT_TRUE(sqrt(Ball()).is_exact_zero());
}

TEST(Ball, RootOfABallAroundZeroReachesFromZeroToTheRootOfItsUpperEnd) {
  const Ball root = sqrt(Ball::with_error({-0x1p-60, 0}, 0x1p-40));
  EXPECT_EQ(root.sign(), 0);
  EXPECT_GE(root.magnitude(), std::sqrt(0x1p-40 - 0x1p-60));
  EXPECT_LE(root.magnitude(), 2 * std::sqrt(0x1p-40));
}

TEST(Ball, QuotientByABallWhoseEndIsAlmostZeroIsFinite) {
  const double error = 1;
  double value = error;
  while (Ball::with_error({value, 0}, error).sign() == 0) value = std::nextafter(value, 2);
  const Ball quotient = Ball(1) / Ball::with_error({value, 0}, error);
  EXPECT_TRUE(std::isfinite(quotient.error()));
  EXPECT_TRUE(contains(quotient, Exact2304(1) / (Exact2304(value) - Exact2304(error))));
}

TEST(Ball, ProductOfALargeAndASmallNumberKeepsItsDigits) {
  const Ball product = Ball(1e300) * Ball(1e300) * Ball(1e-300) * Ball(1e-300) * Ball(3);
  EXPECT_LE(product.error(), 0x1p-99);
  EXPECT_EQ(product.nearest_double(),
            (Exact2304(1e300) * Exact2304(1e300) * Exact2304(1e-300) * Exact2304(1e-300) * Exact2304(3))
                .nearest_double());
}

TEST(Ball, SignIsNeverThatOfAnotherMember) {
  RandomNumbers random(11);
  for (int i = 0; i < 100'000; ++i) {
    const Ball ball = any_ball(random);
    if (ball.sign() == 0) continue;
    for (const Exact2304& x : members(ball, random))
      ASSERT_EQ(x.sign(), ball.sign()) << testing::PrintToString(ball);
  }
}

TEST(Ball, SignIsKnownUnlessItReachesZero) {
  EXPECT_EQ(Ball(kSmallest).sign(), 1);
  EXPECT_EQ(Ball(-1e-300).sign(), -1);
  EXPECT_EQ((Ball(-1e-300) * Ball(1e-300)).sign(), -1);
  EXPECT_EQ(Ball().sign(), 0);
  // A ball that reaches zero:
  EXPECT_EQ(Ball::with_error({1, 0}, 1).sign(), 0);
  EXPECT_EQ(Ball::with_error({-1, 0}, 2).sign(), 0);
}

TEST(Ball, NearestDoubleIsThatOfTheMidpoint) {
  RandomNumbers random(12);
  for (int i = 0; i < 200'000; ++i) {
    Ball ball = Ball::with_error(random.double_double(-20, 20), 0x1p-90) * Ball(random.any_double());
    if (i % 2 == 0) ball = ball * Ball(random.any_double());
    const double expected = midpoint<2304>(ball).nearest_double();
    ASSERT_EQ(ball.nearest_double(), expected) << testing::PrintToString(ball);
  }
}

TEST(Ball, NearestDoubleBelowTheNormalRangeIsRoundedOnce) {
  RandomNumbers random(13);
  for (int i = 0; i < 200'000; ++i) {
    // Halfway between two subnormal numbers, and the smallest amount to one side or exactly on the tie.
    const double half = std::ldexp(2.0 * random.whole(0, 100) + 1, 0);
    const double low = random.whole(-1, 1) * std::ldexp(1.0, random.whole(-90, -60));
    const Ball ball = (Ball(half) + Ball(low)) * Ball(kSmallest) * Ball(0.5);
    const double expected = midpoint<2304>(ball).nearest_double();
    ASSERT_EQ(ball.nearest_double(), expected) << testing::PrintToString(ball);
  }
}

TEST(Ball, NearestDoublePastTheRangeIsInfinite) {
  EXPECT_EQ((Ball(1e300) * Ball(1e300)).nearest_double(), HUGE_VAL);
  EXPECT_EQ((Ball(-kLargest) * Ball(kLargest) * Ball(kLargest)).nearest_double(), -HUGE_VAL);
}

TEST(Ball, NearestDoubleFarBelowTheRangeIsZeroWhateverTheError) {
  const Ball unknown = Ball::with_error({0, 0}, 1e300) * Ball(1e300) * Ball(1e300) * Ball(1e300);
  EXPECT_EQ(unknown.nearest_double(), 0);
  EXPECT_EQ((Ball(1e-300) * Ball(1e-300)).nearest_double(), 0);
  EXPECT_EQ((Ball(kSmallest) * Ball(kSmallest) * Ball(kSmallest)).nearest_double(), 0);
}

TEST(Ball, ErrorCanBeLoweredToAKnownBound) {
  const Ball ball = Ball::with_error({3, 0}, 0x1p-50).with_error_at_most(0x1p-80);
  EXPECT_GE(ball.radius(), 0x1p-80);
  EXPECT_LE(ball.radius(), 0x1p-79);
  EXPECT_EQ(ball.nearest_double(), 3);
}

TEST(Ball, ErrorIsNotRaisedToABound) {
  EXPECT_EQ(Ball::with_error({3, 0}, 0x1p-50).with_error_at_most(0x1p-40), Ball::with_error({3, 0}, 0x1p-50));
  EXPECT_TRUE(Ball(3).with_error_at_most(1).is_exact());
}

TEST(Ball, LoweredErrorHoldsTheBoundInEveryRange) {
  RandomNumbers random(14);
  for (int i = 0; i < 100'000; ++i) {
    const Ball ball = any_ball(random);
    const double bound = std::fabs(random.any_double());
    const Ball lowered = ball.with_error_at_most(bound);
    const Exact2304 expected = std::min(Exact2304(bound), radius<2304>(ball));
    ASSERT_GE(radius<2304>(lowered), expected)
        << testing::PrintToString(ball) << ", " << std::hexfloat << bound;
    ASSERT_LE(radius<2304>(lowered), radius<2304>(ball));
    ASSERT_EQ(midpoint<2304>(lowered), midpoint<2304>(ball)) << testing::PrintToString(ball);
  }
}

TEST(Ball, MagnitudeAndRadiusAreUpperBounds) {
  RandomNumbers random(15);
  for (int i = 0; i < 100'000; ++i) {
    const Ball ball = any_ball(random);
    const Exact2304 error = radius<2304>(ball);
    const double magnitude = ball.magnitude();
    const double ball_radius = ball.radius();
    ASSERT_GE(Exact2304(magnitude), abs(midpoint<2304>(ball)) + error) << testing::PrintToString(ball);
    ASSERT_GE(Exact2304(ball_radius), error) << testing::PrintToString(ball);
  }
}

TEST(Ball, AnErrorThatLosesBitsOnTheWayToAnotherRangeDoesNotShrink) {
  // The midpoint is moved to 1, and 1.25 * 2^-74 to 1.25 * 2^-1074: between the two smallest doubles.
  const Ball ball = Ball::with_error({0x1p1000, 0}, 0x1.4p-74);
  EXPECT_EQ(midpoint<2304>(ball), Exact2304(0x1p1000));
  EXPECT_GE(radius<2304>(ball), Exact2304(0x1.4p-74));
}

TEST(Ball, MidpointsFarBelowTheirErrorsAreContained) {
  RandomNumbers random(16);
  const std::array<Ball, 6> balls = {Ball::with_error({0x1p-740, 0x1p-800}, 0x1p290),
                                     Ball::with_error({0x1p-380, 0x1p-440}, 0x1p600),
                                     Ball::with_error({-0x1p-1000, 0x1p-1060}, 0x1p600),
                                     Ball(0x1p-400),
                                     Ball(0x1p700),
                                     Ball(-3)};
  for (const Ball& a : balls)
    for (const Ball& b : balls) {
      expect_image(a + b, a, b, random, kAdd);
      expect_image(a - b, a, b, random, kSubtract);
      expect_image(a * b, a, b, random, kMultiply);
    }
}

TEST(Ball, IsEqualIfAllItsPartsAre) {
  const Ball ball = Ball::with_error({1, 0x1p-60}, 0x1p-110);
  EXPECT_EQ(ball, Ball::with_error({1, 0x1p-60}, 0x1p-110));
  EXPECT_NE(ball, Ball::with_error({2, 0x1p-60}, 0x1p-110));
  EXPECT_NE(ball, Ball::with_error({1, 0x1p-61}, 0x1p-110));
  EXPECT_NE(ball, Ball::with_error({1, 0x1p-60}, 0x1p-111));
  EXPECT_EQ(Ball(0x1p-400), Ball(0x1p-400));
  EXPECT_NE(Ball(0x1p-400), Ball(0x1p-401));
  EXPECT_EQ((BallVec3{1, 2, 3}), (BallVec3{1, 2, 3}));
  for (const BallVec3& other : {BallVec3{0, 2, 3}, BallVec3{1, 0, 3}, BallVec3{1, 2, 0}})
    EXPECT_FALSE((BallVec3{1, 2, 3}) == other);
}

TEST(Ball, AVerySmallErrorIsNotForgotten) {
  const Ball ball = Ball::with_error({1, 0}, std::numeric_limits<double>::min());
  EXPECT_FALSE((ball * Ball(0x1p-300) * Ball(0x1p-300)).is_exact());
  EXPECT_FALSE((ball * ball).is_exact());
}

}  // namespace
}  // namespace pipeline
