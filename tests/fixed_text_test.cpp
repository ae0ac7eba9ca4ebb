#include "libpipeline/fixed_text.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace pipeline {
namespace {

/// Every claim is made of every kernel that this processor can run.
class FixedText : public testing::TestWithParam<FixedTextKernel> {
 protected:
  /// Reads from a copy that is followed by digits, which must not become part of the last number.
  static FixedTextPart read(const std::string& text, std::vector<Triangle>& triangles) {
    const std::string with_slack = text + std::string(kFixedTextSlack, '7');
    return GetParam().read({with_slack.data(), text.size()}, triangles);
  }

  static std::size_t count_read(const std::string& text) {
    std::vector<Triangle> triangles(10);
    return read(text, triangles).triangle_count;
  }

  static std::string write(const std::vector<Triangle>& triangles, std::size_t& count) {
    std::string out(triangles.size() * kMaxFixedTriangleLength + kFixedTextSlack, '\0');
    const FixedTextPart part = GetParam().write(triangles, out.data());
    count = part.triangle_count;
    out.resize(part.length);
    return out;
  }
};

std::string general_text(double value) {
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, 7).ptr;
  const std::string printed(text.data(), end);
  return printed == "-0.0000000" ? "0.0000000" : printed;
}

std::string general_text(const Triangle& t) {
  std::string text;
  for (const Vec3& v : t)
    text += general_text(v.x) + " " + general_text(v.y) + " " + general_text(v.z) + "\n";
  return text + "\n";
}

double general_number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

const std::string kUnit =
    "0.0000000 0.0000000 0.0000000\n1.0000000 0.0000000 0.0000000\n0.0000000 1.0000000 0.0000000\n\n";

TEST_P(FixedText, ReadsATriangle) {
  std::vector<Triangle> triangles(3);
  const FixedTextPart part = read(
      "-1.5000000 0.0000000 12345678.1234567\n0.0000001 -0.1000000 3.0000000\n"
      "99999999.9999999 1.0000000 -10.2500000\n\n",
      triangles);
  ASSERT_EQ(part.triangle_count, 1u);
  EXPECT_EQ(triangles[0][0], (Vec3{-1.5, 0, 12345678.1234567}));
  EXPECT_EQ(triangles[0][1], (Vec3{1e-7, -0.1, 3}));
  EXPECT_EQ(triangles[0][2], (Vec3{99999999.9999999, 1, -10.25}));
}

TEST_P(FixedText, ReadsTheSignOfZero) {
  std::vector<Triangle> triangles(1);
  read("-0.0000000 0.0000000 0.0000000\n1.0000000 0.0000000 0.0000000\n0.0000000 1.0000000 0.0000000\n\n",
       triangles);
  EXPECT_TRUE(std::signbit(triangles[0][0].x));
  EXPECT_FALSE(std::signbit(triangles[0][0].y));
}

TEST_P(FixedText, StopsBehindTheLastWholeTriangle) {
  std::vector<Triangle> triangles(3);
  const FixedTextPart part = read(kUnit + kUnit.substr(0, kUnit.size() - 1), triangles);
  EXPECT_EQ(part.triangle_count, 1u);
  EXPECT_EQ(part.length, kUnit.size());
}

TEST_P(FixedText, StopsWhenThereIsNoRoom) {
  std::vector<Triangle> triangles(2);
  EXPECT_EQ(read(kUnit + kUnit + kUnit, triangles).length, 2 * kUnit.size());
}

TEST_P(FixedText, EveryOneOfItsBytesMatters) {
  // Whatever byte is put in place of another: read as what it says now, or left to the general reader.
  for (std::size_t i = 0; i < kUnit.size(); ++i) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string text = kUnit;
      text[i] = static_cast<char>(byte);
      const bool is_digit_for_digit = byte >= '0' && byte <= '9' && kUnit[i] >= '0' && kUnit[i] <= '9';
      ASSERT_EQ(count_read(text), is_digit_for_digit || text == kUnit ? 1u : 0u) << i << " " << byte;
    }
  }
}

TEST_P(FixedText, LeavesEveryOtherFormAlone) {
  for (const char* const number :
       {"1", "1.", ".5000000", "1.000000", "1.00000000", "123456789.0000000", "+1.0000000", "1e5",
        "1.0000000e1", "--1.0000000", "", "-", "nan", "1.00000a0", "#", " 1.0000000"}) {
    std::string text = kUnit;
    text.replace(0, 9, number);
    EXPECT_EQ(count_read(text), 0u) << number;
  }
}

TEST_P(FixedText, ReadsWhatTheGeneralReaderReads) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 30000; ++i) {
    std::array<std::string, 9> words;
    for (std::string& word : words) {
      const std::uint64_t units = random() % 1'000'000'000'000'000 >> (random() % 50);
      std::string decimals = std::to_string(units % 10'000'000);
      decimals.insert(0, 7 - decimals.size(), '0');
      word = (random() % 2 == 0 ? "-" : "") + std::to_string(units / 10'000'000) + "." + decimals;
    }
    std::string text;
    for (std::size_t k = 0; k < 9; ++k) text += words[k] + (k % 3 == 2 ? "\n" : " ");
    std::vector<Triangle> triangles(1);
    ASSERT_EQ(read(text + "\n", triangles).triangle_count, 1u) << text;
    for (std::size_t k = 0; k < 9; ++k) {
      const Vec3& v = triangles[0][k / 3];
      const double value = k % 3 == 0 ? v.x : (k % 3 == 1 ? v.y : v.z);
      ASSERT_EQ(std::bit_cast<std::uint64_t>(value), std::bit_cast<std::uint64_t>(general_number(words[k])))
          << words[k];
    }
  }
}

TEST_P(FixedText, PrintsZeroWithoutASign) {
  std::size_t count = 0;
  EXPECT_EQ(
      write({Triangle{{{-0.0, -4e-8, 0}, {1, -1, -1e-300}, {-5.1e-8, 0, 0}}}}, count),
      "0.0000000 0.0000000 0.0000000\n1.0000000 -1.0000000 0.0000000\n-0.0000001 0.0000000 0.0000000\n\n");
}

TEST_P(FixedText, PrintsUpToEightDigitsBeforeThePoint) {
  std::size_t count = 0;
  EXPECT_EQ(
      write({Triangle{{{99999999.9999999, -99999999, 10}, {9.9999999, 100, 0.1}, {1234567.5, 0, 0}}}}, count),
      "99999999.9999999 -99999999.0000000 10.0000000\n9.9999999 100.0000000 0.1000000\n"
      "1234567.5000000 0.0000000 0.0000000\n\n");
}

TEST_P(FixedText, LeavesToTheGeneralPrinterWhatItCannotPrint) {
  // Nine digits, a carry into the ninth, exact ties at the eighth decimal, no numbers at all.
  for (const double value :
       {1e8, 99999999.99999999, 0.00390625, -1.01171875, 1e300, HUGE_VAL, std::nan("")}) {
    std::size_t count = 1;
    EXPECT_EQ(write({Triangle{{{0, 0, 0}, {0, value, 0}, {0, 0, 0}}}}, count), "") << value;
    EXPECT_EQ(count, 0u) << value;
  }
}

TEST_P(FixedText, StopsBeforeTheFirstTriangleItCannotPrint) {
  const Triangle unit = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const Triangle large = {{{0, 0, 1e9}, {1, 0, 0}, {0, 1, 0}}};
  std::size_t count = 0;
  EXPECT_EQ(write({unit, unit, large, unit}, count), general_text(unit) + general_text(unit));
  EXPECT_EQ(count, 2u);
}

/// Prints random coordinates, many of them next to ties, and compares with the general printer.
void print_random(const WriteFixedText write_kernel, int triangle_count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::string out(kMaxFixedTriangleLength + kFixedTextSlack, '\0');
  int printed_count = 0;
  for (int i = 0; i < triangle_count; ++i) {
    std::array<double, 9> values;
    for (double& value : values) {
      value = std::ldexp(mantissa(random), static_cast<int>(random() % 60) - 33);
      if (random() % 4 != 0) continue;
      value = (std::floor(std::fabs(value) * 1e7) + 0.5) / 1e7;
      for (std::uint64_t steps = random() % 4; steps > 0; --steps)
        value = std::nextafter(value, random() % 2 == 0 ? 1e9 : -1e9);
    }
    const auto triangle = std::bit_cast<Triangle>(values);
    const FixedTextPart part = write_kernel({&triangle, 1}, out.data());
    if (part.triangle_count == 0) continue;
    ++printed_count;
    ASSERT_EQ(out.substr(0, part.length), general_text(triangle));
  }
  EXPECT_GT(printed_count, triangle_count / 10);
}

TEST_P(FixedText, PrintsWhatTheGeneralPrinterPrints) {
  print_random(GetParam().write, 30000, 2);
}

TEST_P(FixedText, LongPrintsWhatTheGeneralPrinterPrintsOnTenMillionNumbers) {
  print_random(GetParam().write, 10'000'000 / 9, 3);
}

INSTANTIATE_TEST_SUITE_P(Kernels, FixedText,
                         testing::ValuesIn(fixed_text_kernels().begin(), fixed_text_kernels().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pipeline
