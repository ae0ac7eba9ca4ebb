#include "libpipeline/numbers/fixed_int.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "tests/numbers/random_numbers.h"
#include "tests/sanitizer_rounds.h"

namespace pipeline {
namespace {

using Int6 = FixedInt<6>;

mpz_class exact(const Int6& value) {
  mpz_class result = 0;
  for (std::size_t i = 6; i-- > 0;) {
    mpz_class limb;
    const std::uint64_t bits = value.limb(i);
    mpz_import(limb.get_mpz_t(), 1, 1, sizeof bits, 0, 0, &bits);
    result = result * (mpz_class(1) << 64) + limb;
  }
  return value.is_negative() ? mpz_class(result - (mpz_class(1) << 384)) : result;
}

/// A number of at most `most_bits` bits and either sign, often next to a power of two.
Int6 any_number(RandomNumbers& random, int most_bits) {
  const int bits = random.whole(0, most_bits);
  Int6 value(0);
  for (int i = 0; i < bits; i += 32) {
    const int taken = std::min(bits - i, 32);
    value = (value << taken) + Int6(static_cast<std::int64_t>(random.bits() >> (64 - taken)));
  }
  if (random.bits() % 4 == 0) value = (Int6(1) << bits) + Int6(random.whole(-1, 1));
  return random.bits() % 2 == 0 ? value : -value;
}

TEST(FixedInt, SumsDifferencesProductsAndOrderAreExact) {
  RandomNumbers random(1);
  for (int i = 0; i < sanitizer_rounds(20000); ++i) {
    const Int6 a = any_number(random, 180), b = i % 10 == 0 ? a : any_number(random, 180);
    const int small = random.whole(-100000, 100000);
    ASSERT_TRUE(exact(a + b) == exact(a) + exact(b));
    ASSERT_TRUE(exact(a - b) == exact(a) - exact(b));
    ASSERT_TRUE(exact(-a) == -exact(a));
    ASSERT_TRUE(exact(a * b) == exact(a) * exact(b));
    ASSERT_TRUE(exact(small * a) == small * exact(a));
    ASSERT_TRUE((a < b) == (exact(a) < exact(b)));
    ASSERT_TRUE((a > b) == (exact(a) > exact(b)));
    ASSERT_TRUE((a == b) == (exact(a) == exact(b)));
  }
}

TEST(FixedInt, TakesBuiltInNumbersOfEitherSign) {
  EXPECT_TRUE(exact(Int6(0)) == 0);
  EXPECT_TRUE(exact(Int6(-1)) == -1);
  EXPECT_TRUE(exact(Int6((Int128{-5} << 100))) == mpz_class(-5) * (mpz_class(1) << 100));
  EXPECT_TRUE(exact(Int6(FixedInt<9>(-7) * FixedInt<9>(11))) == -77);
  EXPECT_TRUE(exact(Int6(FixedInt<2>(-7))) == -7);
  EXPECT_TRUE(exact(Int6(FixedInt<2>(7))) == 7);
}

TEST(FixedInt, ShiftsAndCutsAtEveryBit) {
  RandomNumbers random(2);
  for (int bits = 0; bits < 200; ++bits) {
    const Int6 a = any_number(random, 180);
    ASSERT_TRUE(exact(a << bits) == exact(a) * (mpz_class(1) << static_cast<unsigned>(bits)));
    ASSERT_EQ(cut(Int6(Int128{-77}) << bits, bits), -77);
    ASSERT_EQ(cut((Int6(Int128{-77}) << bits) + Int6(bits == 0 ? 0 : 1), bits), -77);
    ASSERT_EQ(bit_length(Int6(1) << bits), bits + 1);
    ASSERT_EQ(bit_length(-(Int6(1) << bits)), bits);
  }
  EXPECT_EQ(bit_length(Int6(0)), 0);
}

TEST(FixedInt, BecomesADoubleNextToIt) {
  RandomNumbers random(3);
  for (int i = 0; i < sanitizer_rounds(20000); ++i) {
    const Int6 a = any_number(random, 300);
    const mpq_class error = abs(mpq_class(to_double(a, 0)) - mpq_class(exact(a)));
    ASSERT_TRUE(error <= abs(mpq_class(exact(a))) * (mpq_class(0x1p-53) + mpq_class(0x1p-61)));
    ASSERT_EQ(to_double(a, 40), std::ldexp(to_double(a, 0), -40));
    const auto narrow = static_cast<Int128>(cut(a, std::max(bit_length(a) - 62, 0))) * 987654321;
    ASSERT_EQ(to_double(narrow, 40), std::ldexp(to_double(narrow), -40));
    const mpq_class narrow_error = abs(mpq_class(to_double(narrow)) - mpq_class(exact(Int6(narrow))));
    ASSERT_TRUE(narrow_error <=
                abs(mpq_class(exact(Int6(narrow)))) * (mpq_class(0x1p-53) + mpq_class(0x1p-61)));
  }
}

TEST(FixedInt, BuiltInNumbersAreScaledLikeIt) {
  EXPECT_EQ(to_double(std::int64_t{-77}, 40), -77 * 0x1p-40);
  EXPECT_EQ(to_double(Int128{-77} << 80, 40), -77 * 0x1p40);
  EXPECT_EQ(to_double(Int6(-77), 40), -77 * 0x1p-40);
}

/// The definition, digit by digit.
int rounded_up(const mpz_class& dividend, const mpz_class& divisor, int most) {
  mpz_class quotient;
  mpz_cdiv_q(quotient.get_mpz_t(), dividend.get_mpz_t(), divisor.get_mpz_t());
  return quotient < 0 ? 0 : quotient > most ? most : static_cast<int>(quotient.get_si());
}

TEST(Divisor, RoundsUpExactlyAroundEveryMultiple) {
  RandomNumbers random(4);
  for (int i = 0; i < sanitizer_rounds(20000); ++i) {
    const int most = i % 2 == 0 ? 65535 : random.whole(1, 50);
    const Int6 any = any_number(random, 180);
    const Int6 divisor = any > 0 ? any : Int6(1) - any;
    // At a multiple, next to it, anywhere, and far outside.
    Int6 dividend = random.whole(-2, most + 2) * divisor + Int6(random.whole(-1, 1));
    if (i % 5 == 0) dividend = any_number(random, 300);
    ASSERT_EQ(Divisor(divisor).quotient_rounded_up(dividend, most),
              rounded_up(exact(dividend), exact(divisor), most));
    const auto narrow = std::int64_t{random.whole(1, 2'000'000'000)} * random.whole(1, 1000);
    const std::int64_t near_multiple = narrow * random.whole(-2, most + 2) + random.whole(-1, 1);
    ASSERT_EQ(Divisor(narrow).quotient_rounded_up(near_multiple, most),
              rounded_up(exact(Int6(near_multiple)), exact(Int6(narrow)), most));
    ASSERT_EQ(Divisor(Int128{narrow} << 50).quotient_rounded_up(Int128{near_multiple} << 50, most),
              rounded_up(exact(Int6(near_multiple)), exact(Int6(narrow)), most));
  }
}

}  // namespace
}  // namespace pipeline
