#include "libpipeline/raytracing/refraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace pipeline {
namespace {

TEST(Decay, IsWithinItsBoundOfTheExponential) {
  std::mt19937_64 rng(1);
  std::uniform_real_distribution<double> exponent(-60, 9.46);
  for (int i = 0; i < 200'000; ++i) {
    const double x = std::exp2(exponent(rng));
    const long double expected = std::exp(-static_cast<long double>(x));
    const long double error = std::fabs(static_cast<long double>(decay(x)) - expected) / expected;
    ASSERT_LT(error, 0x1p-50L) << x;
  }
}

TEST(Decay, NeverGrows) {
  double last = 1;
  for (int i = 0; i < 100'000; ++i) {
    const double now = decay(i * 0.0075);
    ASSERT_LE(now, last) << i;
    last = now;
  }
}

TEST(Decay, HasEnds) {
  EXPECT_EQ(decay(0), 1);
  EXPECT_EQ(decay(746), 0);
  EXPECT_EQ(decay(std::numeric_limits<double>::infinity()), 0);
  EXPECT_GT(decay(745), 0);
}

}  // namespace
}  // namespace pipeline
