#include "libpipeline/text/fixed_text.h"

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

/// Every claim is tested with every kernel that this processor can run.
class FixedText : public testing::TestWithParam<FixedTextKernel> {
 protected:
  /// Reads from a copy that is followed by digits, which must not become part of the last number.
  static FixedTextPart read(const std::string& text, std::vector<Triangle>& triangles) {
    const std::string with_slack = text + std::string(kFixedTextSlack, '7');
    return GetParam().read({with_slack.data(), text.size()}, triangles);
  }

  static FixedTextPart read_scene(const std::string& text, std::vector<Triangle>& triangles) {
    const std::string with_slack = text + std::string(kFixedTextSlack, '7');
    return GetParam().read_scene({with_slack.data(), text.size()}, triangles);
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
  // A triangle with one byte replaced is read only if a digit replaced a digit.
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

TEST_P(FixedText, LeavesLongNumbersAlone) {
  for (std::size_t length = 9; length <= 40; ++length) {
    const std::string number = std::string(length, '2') + ".0000000";
    EXPECT_EQ(count_read(number + kUnit.substr(9)), 0u) << number;
  }
}

TEST_P(FixedText, ReadsTheTrianglesOfAScene) {
  const std::string triangle = "triangle\n" + kUnit.substr(0, kUnit.size() - 1);
  std::vector<Triangle> triangles(3);
  const FixedTextPart part = read_scene(triangle + triangle + "pop\n" + triangle, triangles);
  EXPECT_EQ(part.triangle_count, 2u);
  EXPECT_EQ(part.length, 2 * triangle.size());
  EXPECT_EQ(triangles[1], (Triangle{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}));
}

TEST_P(FixedText, EveryByteOfASceneMatters) {
  const std::string triangle = "triangle\n" + kUnit.substr(0, kUnit.size() - 1);
  for (std::size_t i = 0; i < triangle.size(); ++i) {
    for (int byte = 0; byte < 256; ++byte) {
      std::string text = triangle;
      text[i] = static_cast<char>(byte);
      const bool is_digit_for_digit = byte >= '0' && byte <= '9' && triangle[i] >= '0' && triangle[i] <= '9';
      std::vector<Triangle> triangles(2);
      ASSERT_EQ(read_scene(text, triangles).triangle_count, is_digit_for_digit || text == triangle ? 1u : 0u)
          << i << " " << byte;
    }
  }
}

TEST_P(FixedText, StopsBeforeATriangleOfASceneThatIsNotThereAsAWhole) {
  const std::string triangle = "triangle\n" + kUnit.substr(0, kUnit.size() - 1);
  for (std::size_t length = 0; length < triangle.size(); ++length) {
    std::vector<Triangle> triangles(2);
    ASSERT_EQ(read_scene(triangle + triangle.substr(0, length), triangles).length, triangle.size()) << length;
  }
}

/// A decimal of up to eight digits before the point and seven after it.
std::string random_word(std::mt19937_64& random) {
  const std::uint64_t units = random() % 1'000'000'000'000'000 >> (random() % 50);
  std::string decimals = std::to_string(units % 10'000'000);
  decimals.insert(0, 7 - decimals.size(), '0');
  return (random() % 2 == 0 ? "-" : "") + std::to_string(units / 10'000'000) + "." + decimals;
}

/// Reads random triangles and compares with from_chars.
void read_random(const ReadFixedText read_kernel, int triangle_count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < triangle_count; ++i) {
    std::array<double, 9> expected;
    std::string text;
    for (std::size_t k = 0; k < 9; ++k) {
      const std::string word = random_word(random);
      expected[k] = general_number(word);
      text += word + (k % 3 == 2 ? "\n" : " ");
    }
    text += "\n";
    const std::size_t length = text.size();
    text.append(kFixedTextSlack, '7');
    std::array<Triangle, 1> triangle;
    ASSERT_EQ(read_kernel({text.data(), length}, triangle).triangle_count, 1u) << text;
    const auto bits = std::bit_cast<std::array<std::uint64_t, 9>>(triangle);
    ASSERT_EQ(bits, (std::bit_cast<std::array<std::uint64_t, 9>>(expected))) << text;
  }
}

TEST_P(FixedText, ReadsWhatTheGeneralReaderReads) {
  read_random(GetParam().read, 30000, 1);
}

TEST_P(FixedText, LongReadsWhatTheGeneralReaderReadsOnAHundredMillionNumbers) {
  read_random(GetParam().read, 100'000'000 / 9, 4);
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
  // Nine digits, a carry into the ninth, exact ties at the eighth decimal, infinities and NaN.
  for (const double value :
       {1e8, 99999999.99999999, 0.00390625, -1.01171875, 1e300, HUGE_VAL, std::nan("")}) {
    std::size_t count = 1;
    EXPECT_EQ(write({Triangle{{{0, 0, 0}, {0, value, 0}, {0, 0, 0}}}}, count), "") << value;
    EXPECT_EQ(count, 0u) << value;
  }
}

// An odd multiple of 2^-8 ends in a 5 at the eighth decimal.
TEST_P(FixedText, LeavesEveryTieToTheGeneralPrinter) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 20000; ++i) {
    const double tie = static_cast<double>(2 * (random() % (1u << 30 >> random() % 30)) + 1) / 256;
    std::size_t count = 1;
    write({Triangle{{{0, 0, 0}, {random() % 2 == 0 ? tie : -tie, 0, 0}, {0, 0, 0}}}}, count);
    ASSERT_EQ(count, 0u) << tie;
  }
}

TEST_P(FixedText, PrintsWhatLiesBesideATieOrLeavesIt) {
  std::mt19937_64 random(6);
  int printed_count = 0;
  for (int i = 0; i < 20000; ++i) {
    const double tie = static_cast<double>(2 * (random() % (1u << 30 >> random() % 30)) + 1) / 256;
    for (const double value :
         {std::nextafter(tie, 0), std::nextafter(tie, HUGE_VAL), tie - 1e-9, tie + 1e-9}) {
      const Triangle triangle = {{{0, 0, 0}, {0, 0, value}, {-value, 0, 0}}};
      std::size_t count = 0;
      const std::string text = write({triangle}, count);
      ASSERT_EQ(text, count > 0 ? general_text(triangle) : "") << tie;
      printed_count += count > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(printed_count, 20000);
}

// Where the number of digits changes: powers of ten, their neighbors one unit away, and powers of two up to
// 2^53.
TEST_P(FixedText, PrintsPowersAndTheirNeighborsOrLeavesThem) {
  std::vector<double> values;
  for (int exponent = -9; exponent <= 9; ++exponent) values.push_back(std::pow(10.0, exponent));
  for (int exponent = -60; exponent <= 54; ++exponent) values.push_back(std::ldexp(1.0, exponent));
  int printed_count = 0;
  for (const double power : values)
    for (const double step : {0.0, 1e-7, 0.5e-7, 0.49e-7, 1e-15})
      for (const double value : {power - step, power + step, step - power}) {
        const Triangle triangle = {{{value, 0, 0}, {0, value, 0}, {0, 0, value}}};
        std::size_t count = 0;
        const std::string text = write({triangle}, count);
        ASSERT_EQ(text, count > 0 ? general_text(triangle) : "") << value;
        printed_count += count > 0 ? 1 : 0;
      }
  EXPECT_GT(printed_count, 800);
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

TEST_P(FixedText, LongPrintsWhatTheGeneralPrinterPrintsOnAHundredMillionNumbers) {
  print_random(GetParam().write, 100'000'000 / 9, 3);
}

INSTANTIATE_TEST_SUITE_P(Kernels, FixedText,
                         testing::ValuesIn(fixed_text_kernels().begin(), fixed_text_kernels().end()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pipeline
