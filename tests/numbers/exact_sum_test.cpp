#include "libpipeline/numbers/exact_sum.h"

#include <gtest/gtest.h>

#include "tests/numbers/random_numbers.h"
#include "tests/numbers/real.h"
#include "tests/sanitizer_rounds.h"

namespace pipeline {
namespace {

using Exact = Real<6700>;  // holds every sum of products of three doubles

Exact exact(const Ball& ball) {
  return times_power_of_two(Exact(ball.value()), static_cast<long>(ball.exponent()));
}

TEST(ExactSum, IsRoundedOnceWhateverCancels) {
  RandomNumbers random(1);
  for (int i = 0; i < sanitizer_rounds(2000); ++i) {
    const int reach = random.whole(0, 3) == 0 ? 1020 : 40;
    const auto any = [&] { return random.with_exponent(-reach, reach - 1); };
    const double a = any(), b = any(), c = any(), d = any(), e = any(), f = any();
    const Ball sum = exact_sum({{a, b, c}, {d, e, f}, {-c, a, b}, {-d, e, std::nextafter(f, 0)}});
    const Exact want = Exact(d) * Exact(e) * (Exact(f) - Exact(std::nextafter(f, 0)));
    ASSERT_TRUE(abs(exact(sum) - want) <= times_power_of_two(abs(want), -100)) << a << " " << d;
    ASSERT_EQ(sum.sign(), (d < 0) != (e < 0) ? (f < 0 ? 1 : -1) : (f < 0 ? -1 : 1));
  }
}

TEST(ExactSum, ReachesFromTheSmallestToTheLargestProduct) {
  const double tiny = 0x1p-1074, huge = std::numeric_limits<double>::max();
  EXPECT_EQ(exact_sum({{huge, huge, huge}, {tiny, tiny, -tiny}, {-huge, huge, huge}}).sign(), -1);
  EXPECT_EQ(exact_sum({{huge, huge, huge, -huge}, {tiny, tiny, tiny, tiny}, {huge, huge, huge, huge}}).sign(),
            1);
  EXPECT_TRUE(exact_sum({{huge, huge, huge}, {tiny, 0, tiny}, {-huge, huge, huge}}).is_exact_zero());
  EXPECT_TRUE(exact_sum({}).is_exact_zero());
}

}  // namespace
}  // namespace pipeline
