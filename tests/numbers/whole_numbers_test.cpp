#include "libpipeline/numbers/fixed_int.h"

#include <gtest/gtest.h>

#include "tests/numbers/random_numbers.h"

namespace pipeline {
namespace {

template <typename Int>
class WholeNumbers : public testing::Test {};
using Types = testing::Types<std::int64_t, Int128, FixedInt<2>, FixedInt<4>>;
TYPED_TEST_SUITE(WholeNumbers, Types);

constexpr std::int64_t kLarge = std::int64_t{1} << 40;

TYPED_TEST(WholeNumbers, DividesByPowersOfTwo) {
  for (const std::int64_t value : {std::int64_t{0}, std::int64_t{5}, std::int64_t{-5}, kLarge, -kLarge}) {
    EXPECT_EQ(to_double(TypeParam(value), 0), static_cast<double>(value));
    EXPECT_EQ(to_double(TypeParam(value), 2), static_cast<double>(value) / 4);
    EXPECT_EQ(to_double(TypeParam(value), 40), static_cast<double>(value) / static_cast<double>(kLarge));
  }
}

TYPED_TEST(WholeNumbers, CutsDownward) {
  EXPECT_EQ(cut(TypeParam(kLarge + 7), 2), kLarge / 4 + 1);
  EXPECT_EQ(cut(TypeParam(-kLarge - 7), 2), -kLarge / 4 - 2);
  EXPECT_EQ(cut(TypeParam(-1), 40), -1);
}

TEST(DivisorOf128Bits, HasItsHighHalfToo) {
  const Int128 value = (Int128{3} << 100) + (Int128{1} << 99);
  EXPECT_EQ(to_double(value), 7 * 0x1p99);
  EXPECT_EQ(to_double(-value), -7 * 0x1p99);
  EXPECT_EQ(to_double(value, 98), 14);
  EXPECT_EQ(cut(value, 98), 14);
  EXPECT_EQ(bit_length(value), 102);
  EXPECT_EQ(bit_length(Int128{-1} << 100), 100);
  EXPECT_EQ(bit_length(Int128{0}), 0);
}

/// The smallest whole c in [0, most] with c * value >= dividend, or `most`, by trying all.
int counted(std::int64_t dividend, std::int64_t value, int most) {
  int c = 0;
  while (c < most && c * value < dividend) ++c;
  return c;
}

TYPED_TEST(WholeNumbers, QuotientsAreRoundedUpAndKeptInTheirRange) {
  RandomNumbers random(1);
  for (int i = 0; i < 2'000; ++i) {
    const std::int64_t value = i % 2 == 0 ? random.whole(1, 9) : kLarge / random.whole(1, 1000);
    const int most = random.whole(0, 30), times = random.whole(-3, 33);
    const std::int64_t dividend = times * value + random.whole(-1, 1);
    ASSERT_EQ(Divisor<TypeParam>(TypeParam(value)).quotient_rounded_up(TypeParam(dividend), most),
              counted(dividend, value, most))
        << dividend << " / " << value << ", at most " << most;
  }
}

TYPED_TEST(WholeNumbers, QuotientsBesideAWholeNumberAreExact) {
  constexpr int kMost = 1 << 20;
  const std::int64_t value = 3 * kLarge + 1;
  const Divisor<TypeParam> divisor{TypeParam(value)};
  EXPECT_TRUE(divisor.value() == TypeParam(value));
  for (const int c : {1, 2, 777, kMost - 1}) {
    EXPECT_EQ(divisor.quotient_rounded_up(TypeParam(c * value), kMost), c);
    EXPECT_EQ(divisor.quotient_rounded_up(TypeParam(c * value + 1), kMost), c + 1);
    EXPECT_EQ(divisor.quotient_rounded_up(TypeParam(c * value - 1), kMost), c);
  }
}

}  // namespace
}  // namespace pipeline
