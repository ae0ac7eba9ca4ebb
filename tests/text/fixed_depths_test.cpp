#include "libpipeline/text/fixed_depths.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace pipeline {
namespace {

constexpr double kFar = 1e300;

std::string written(const std::vector<double>& depths, double rear, std::size_t& count) {
  std::string out(depths.size() * kMaxFixedDepthLength, '\0');
  const FixedDepths part = write_fixed_depths(depths, rear, out.data());
  count = part.count;
  out.resize(static_cast<std::size_t>(part.end - out.data()));
  return out;
}

TEST(FixedDepths, HaveSixDecimalsAndATab) {
  std::size_t count = 0;
  EXPECT_EQ(written({0.5, -0.25, 1, 12345.0625, 123456789.1, -1e-6}, kFar, count),
            "0.500000\t-0.250000\t1.000000\t12345.062500\t123456789.100000\t-0.000001\t");
  EXPECT_EQ(count, 6u);
}

TEST(FixedDepths, LeaveOutTheRear) {
  std::size_t count = 0;
  EXPECT_EQ(written({1, 0.5, 1, 2, 0.9999999}, 1, count), "0.500000\t1.000000\t");
  EXPECT_EQ(count, 5u);
}

TEST(FixedDepths, ZeroCarriesNoSign) {
  std::size_t count = 0;
  EXPECT_EQ(written({-0.0, -4.9e-7, 4.9e-7, -5.1e-7}, kFar, count),
            "0.000000\t0.000000\t0.000000\t-0.000001\t");
}

TEST(FixedDepths, StopBeforeWhatTheyCannotPrint) {
  // Exact ties (2^-7 has seven decimals), ten digits, infinity.
  for (const double depth : {0.0078125, -0.0234375, 1e9, -1e22, -HUGE_VAL}) {
    std::size_t count = 0;
    EXPECT_EQ(written({0.5, depth, 0.5}, kFar, count), "0.500000\t") << depth;
    EXPECT_EQ(count, 1u) << depth;
  }
}

/// Compares random depths, many of them next to ties, with the general printer. Returns how many of them the
/// fast path printed.
int print_random(int depth_count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  int printed_count = 0;
  for (int i = 0; i < depth_count; ++i) {
    double depth = i % 2 == 0 ? unit(random) : std::ldexp(unit(random), static_cast<int>(random() % 60) - 30);
    if (i % 4 == 3) {
      depth = (std::floor(std::fabs(depth) * 1e6) + 0.5) / 1e6;
      for (std::uint64_t steps = random() % 4; steps > 0; --steps)
        depth = std::nextafter(depth, random() % 2 == 0 ? 1e9 : -1e9);
    }
    std::array<char, kMaxFixedDepthLength> out;
    const FixedDepths part = write_fixed_depths({&depth, 1}, kFar, out.data());
    if (part.count == 0) continue;
    ++printed_count;
    std::array<char, 400> expected;
    char* const end =
        std::to_chars(expected.data(), expected.data() + expected.size(), depth, std::chars_format::fixed, 6)
            .ptr;
    const std::string with_sign(expected.data(), end);
    const std::string number = with_sign == "-0.000000" ? "0.000000" : with_sign;
    if (std::string(out.data(), part.end) != number + "\t") {
      ADD_FAILURE() << number << " became " << std::string(out.data(), part.end);
      break;
    }
  }
  return printed_count;
}

TEST(FixedDepths, AreWhatTheGeneralPrinterPrints) {
  EXPECT_GT(print_random(1'000'000, 1), 700'000);
}

TEST(FixedDepths, LongAreWhatTheGeneralPrinterPrintsOnAHundredMillionNumbers) {
  EXPECT_GT(print_random(100'000'000, 2), 70'000'000);
}

}  // namespace
}  // namespace pipeline
