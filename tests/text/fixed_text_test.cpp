#include "libpipeline/text/fixed_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/numbers/testable_targets.h"

namespace pipeline {
namespace {

/// Reads from a copy that is followed by digits, which must not become part of the last number.
FixedTextPart read_columns(const std::string& text, TriangleFrame frame, const GroupDecimals& decimals,
                           const FixedColumns& columns) {
  const std::string with_slack = text + std::string(kFixedTextSlack, '7');
  return fixed_readers()[columns.form()]({with_slack.data(), text.size()}, frame, decimals, columns);
}

/// Every claim is tested with every kernel that this processor can run, but for the scalar one, which reads
/// and prints nothing. There is one for reading: the last with vectors of sixteen characters.
class FixedText : public testing::TestWithParam<std::size_t> {
 protected:
  static WriteFixedColumns kernel() { return kFixedPrintingKernels[GetParam()]; }

  static FixedTextPart read(const std::string& text, std::vector<Triangle>& triangles, int decimals = 7) {
    return read_columns(text, TriangleFrame::stage_text, {decimals}, {{triangles}, {}});
  }

  static std::size_t count_read(const std::string& text, int decimals = 7) {
    std::vector<Triangle> triangles(10);
    return read(text, triangles, decimals).triangle_count;
  }

  static std::string write(const std::vector<Triangle>& triangles, std::size_t& count, int decimals = 7) {
    std::string out(triangles.size() * kMaxFixedTriangleLength + kFixedTextSlack, '\0');
    const FixedTextPart part = kernel()({{triangles}, {}}, 0, decimals, out.data());
    count = part.triangle_count;
    out.resize(part.length);
    return out;
  }
};

std::string general_text(double value, int decimals = 7) {
  std::array<char, 400> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed, decimals).ptr;
  const std::string printed(text.data(), end);
  return printed[0] == '-' && printed.find_first_not_of("-0.") == std::string::npos ? printed.substr(1)
                                                                                    : printed;
}

std::string general_text(const Triangle& t, int decimals = 7) {
  std::string text;
  for (const Vec3& v : t)
    text += general_text(v.x, decimals) + " " + general_text(v.y, decimals) + " " +
            general_text(v.z, decimals) + "\n";
  return text + "\n";
}

double general_number(const std::string& text) {
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// `digits` after `whole`, or the bare whole number if there are none.
std::string number_text(const std::string& whole, const std::string& digits) {
  return digits.empty() ? whole : whole + "." + digits;
}

/// A triangle whose numbers are all `number`.
std::string text_of_nine(const std::string& number) {
  const std::string line = number + " " + number + " " + number + "\n";
  return line + line + line + "\n";
}

/// The counts of decimals that the kernels read and print.
std::vector<int> all_decimals() {
  std::vector<int> counts;
  for (int count = 0; count <= kMaxFixedDecimals; ++count) counts.push_back(count);
  return counts;
}

const std::string kUnit =
    "0.0000000 0.0000000 0.0000000\n1.0000000 0.0000000 0.0000000\n0.0000000 1.0000000 0.0000000\n\n";

TEST_P(FixedText, EveryOneOfItsBytesMattersWithAnyDecimals) {
  for (std::size_t decimals = 0; decimals < kMaxFixedDecimals; ++decimals) {
    const std::string whole = text_of_nine(number_text("12", std::string(decimals, '5')));
    const auto count = [&](const std::string& text) { return count_read(text, static_cast<int>(decimals)); };
    ASSERT_EQ(count(whole), 1u) << decimals;
    for (std::size_t i = 0; i < whole.size(); ++i)
      for (const char byte : {'7', '/', ':', '.', ' ', '\n', '-', '+', 'e', '\r'}) {
        std::string text = whole;
        text[i] = byte;
        const bool is_digit_for_digit = byte == '7' && whole[i] >= '0' && whole[i] <= '9';
        const bool is_negative_now = byte == '-' && whole[i] == '1';  // -2.5 for 12.5
        const bool ends_earlier = decimals == 0 && byte == '\n' && i == whole.size() - 3;
        const bool is_fine = is_digit_for_digit || is_negative_now || ends_earlier || text == whole;
        ASSERT_EQ(count(text), is_fine ? 1u : 0u) << decimals << " " << i << " " << byte;
      }
  }
}

TEST_P(FixedText, LeavesNumbersWithOtherDecimalsAlone) {
  for (const int decimals : all_decimals())
    for (const int others : {decimals - 1, decimals + 1, decimals + 5}) {
      if (others < 0) continue;
      const auto digits = [](int count) { return std::string(static_cast<std::size_t>(count), '1'); };
      const std::string number = number_text("3", digits(decimals));
      std::string text = text_of_nine(number);
      ASSERT_EQ(count_read(text, decimals), 1u) << decimals;
      text.replace(0, number.size(), number_text("3", digits(others)));
      ASSERT_EQ(count_read(text, decimals), 0u) << decimals << " " << others;
    }
}

TEST_P(FixedText, ReadsAtMostEightDigitsBeforeThePointAndFifteenInAll) {
  for (const int decimals : all_decimals())
    for (int count = 1; count <= 40; ++count) {
      const std::string number = number_text(std::string(static_cast<std::size_t>(count), '9'),
                                             std::string(static_cast<std::size_t>(decimals), '9'));
      std::vector<Triangle> triangles(1);
      const bool is_read = read(text_of_nine("-" + number), triangles, decimals).triangle_count == 1;
      ASSERT_EQ(is_read, count <= 8 && count + decimals <= 15) << number;
      if (is_read) {
        ASSERT_EQ(triangles[0][2].z, -general_number(number)) << number;
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

/// A decimal of up to eight digits before the point, and 15 in all.
std::string random_word(std::mt19937_64& random, int decimals) {
  const std::uint64_t limit = decimals < 7 ? 100'000'000 : 1'000'000'000'000'000;
  std::string digits = std::to_string(random() % limit >> (random() % 50));
  if (decimals < 7)
    for (int i = 0; i < decimals; ++i) digits += static_cast<char>('0' + random() % 10);
  const auto count = static_cast<std::size_t>(decimals);
  if (digits.size() <= count) digits.insert(0, count + 1 - digits.size(), '0');
  const std::size_t point = digits.size() - count;
  return (random() % 2 == 0 ? "-" : "") + number_text(digits.substr(0, point), digits.substr(point));
}

/// Reads random triangles and compares with from_chars.
void read_random(int decimals, int triangle_count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (int i = 0; i < triangle_count; ++i) {
    std::array<double, 9> expected;
    std::string text;
    for (std::size_t k = 0; k < 9; ++k) {
      const std::string word = random_word(random, decimals);
      expected[k] = general_number(word);
      text += word + (k % 3 == 2 ? "\n" : " ");
    }
    text += "\n";
    std::array<Triangle, 1> triangle;
    ASSERT_EQ(read_columns(text, TriangleFrame::stage_text, {decimals}, {{triangle}, {}}).triangle_count, 1u)
        << text;
    const auto bits = std::bit_cast<std::array<std::uint64_t, 9>>(triangle);
    ASSERT_EQ(bits, (std::bit_cast<std::array<std::uint64_t, 9>>(expected))) << text;
  }
}

TEST_P(FixedText, ReadsWhatTheGeneralReaderReads) {
  read_random(7, 30000, 1);
  for (const int decimals : all_decimals()) read_random(decimals, 3000, 1);
}

// Numbers with one digit before the point are expected after a triangle that has no others.
TEST_P(FixedText, ReadsNumbersOfOneDigitAndOthersInTurn) {
  std::mt19937_64 random(2);
  for (const int decimals : all_decimals()) {
    for (int i = 0; i < 300; ++i) {
      std::array<Triangle, 10> triangles, expected;
      std::string text;
      for (Triangle& triangle : expected) {
        const bool has_others = random() % 2 == 0;
        for (Vec3& vertex : triangle)
          for (double* const number : {&vertex.x, &vertex.y, &vertex.z}) {
            std::string word = random_word(random, decimals);
            if (!has_others || random() % 2 == 0)
              word =
                  word.substr(0, word[0] == '-' ? 2 : 1) + word.substr(std::min(word.find('.'), word.size()));
            *number = general_number(word);
            text += word + (number == &vertex.z ? "\n" : " ");
          }
        text += "\n";
      }
      const FixedTextPart part = read_columns(text, TriangleFrame::stage_text, {decimals}, {{triangles}, {}});
      ASSERT_EQ(part.length, text.size()) << text;
      using Bits = std::array<std::uint64_t, 90>;
      ASSERT_EQ(std::bit_cast<Bits>(triangles), std::bit_cast<Bits>(expected)) << text;
    }
  }
}

TEST_P(FixedText, LongReadsWhatTheGeneralReaderReadsOnAHundredMillionNumbers) {
  for (const int decimals : all_decimals())
    read_random(decimals, (decimals == 7 ? 100'000'000 : 10'000'000) / 9, 4);
}

TEST_P(FixedText, PrintsFifteenDigits) {
  for (const int decimals : all_decimals()) {
    const double largest = 999'999'999'999'999 / std::pow(10.0, decimals);
    for (const double value : {largest, -largest}) {
      const Triangle triangle = {{{value, 0, 0}, {0, 1, 0}, {0, 0, value}}};
      std::size_t count = 0;
      EXPECT_EQ(write({triangle}, count, decimals), general_text(triangle, decimals)) << decimals;
    }
  }
}

TEST_P(FixedText, LeavesToTheGeneralPrinterWhatItCannotPrint) {
  // Nine digits, a carry into the ninth, infinities and NaN.
  for (const double value : {1e8, 99999999.99999999, 1e300, HUGE_VAL, std::nan("")}) {
    std::size_t count = 1;
    EXPECT_EQ(write({Triangle{{{0, 0, 0}, {0, value, 0}, {0, 0, 0}}}}, count), "") << value;
    EXPECT_EQ(count, 0u) << value;
  }
  for (const int decimals : all_decimals())
    for (const double value : {3e15, 0x1p60, 1e300, HUGE_VAL, -HUGE_VAL, std::nan("")}) {
      std::size_t count = 1;
      EXPECT_EQ(write({Triangle{{{0, 0, 0}, {0, 0, 0}, {0, 0, value}}}}, count, decimals), "") << value;
    }
}

// An odd multiple of 2^-(n + 1) ends in a 5 at decimal n + 1.
TEST_P(FixedText, PrintsTiesWithAnyDecimalsAndWhatLiesBesideThemOrLeavesThem) {
  std::mt19937_64 random(7);
  for (const int decimals : all_decimals()) {
    int printed_count = 0;
    for (int i = 0; i < 3000; ++i) {
      const auto odd = static_cast<double>(2 * (random() % (1u << 12 >> random() % 12)) + 1);
      const double tie = std::ldexp(odd, -decimals - 1);
      const double unit = std::pow(10.0, -decimals);
      // The nearest double to a decimal that ends in a 5, which lies beside it.
      const double decimal = (odd / 2) * unit;
      for (const double value : {tie, std::nextafter(tie, 0), std::nextafter(tie, HUGE_VAL), tie - unit / 64,
                                 tie + unit / 64, decimal}) {
        std::size_t count = 0;
        const Triangle triangle = {{{0, 0, 0}, {0, 0, value}, {-value, 0, 0}}};
        const std::string text = write({triangle}, count, decimals);
        ASSERT_EQ(text, count > 0 ? general_text(triangle, decimals) : "") << decimals << " " << tie;
        printed_count += count > 0 ? 1 : 0;
      }
    }
    EXPECT_GE(printed_count, 3000) << decimals;
  }
}

// Where the number of digits changes: powers of ten, their neighbors one unit away, and powers of two up to
// 2^53.
TEST_P(FixedText, PrintsPowersAndTheirNeighborsOrLeavesThem) {
  std::vector<double> values;
  for (int exponent = -9; exponent <= 9; ++exponent) values.push_back(std::pow(10.0, exponent));
  for (int exponent = -60; exponent <= 54; ++exponent) values.push_back(std::ldexp(1.0, exponent));
  for (const int decimals : all_decimals()) {
    const double unit = std::pow(10.0, -decimals);
    int printed_count = 0;
    for (const double power : values)
      for (const double step : {0.0, unit, 0.5 * unit, 0.49 * unit, 1e-8 * unit})
        for (const double value : {power - step, power + step, step - power}) {
          const Triangle triangle = {{{value, 0, 0}, {0, value, 0}, {0, 0, value}}};
          std::size_t count = 0;
          const std::string text = write({triangle}, count, decimals);
          ASSERT_EQ(text, count > 0 ? general_text(triangle, decimals) : "") << decimals << " " << value;
          printed_count += count > 0 ? 1 : 0;
        }
    EXPECT_GT(printed_count, 800) << decimals;
  }
}

/// Prints random coordinates, many of them next to ties, and compares with the general printer.
void print_random(WriteFixedColumns write, int decimals, int triangle_count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::string out(kMaxFixedTriangleLength + kFixedTextSlack, '\0');
  const double scale = std::pow(10.0, decimals);
  int printed_count = 0;
  for (int i = 0; i < triangle_count; ++i) {
    std::array<double, 9> values;
    for (double& value : values) {
      value = std::ldexp(mantissa(random), static_cast<int>(random() % 60) - 10 - 10 * decimals / 3);
      if (random() % 4 != 0) continue;
      value = (std::floor(std::fabs(value) * scale) + 0.5) / scale;
      for (std::uint64_t steps = random() % 4; steps > 0; --steps)
        value = std::nextafter(value, random() % 2 == 0 ? 1e9 : -1e9);
    }
    const auto triangle = std::bit_cast<Triangle>(values);
    const FixedTextPart part = write({{{{&triangle, 1}}}, {}}, 0, decimals, out.data());
    if (part.triangle_count == 0) continue;
    ++printed_count;
    ASSERT_EQ(out.substr(0, part.length), general_text(triangle, decimals));
  }
  EXPECT_GT(printed_count, triangle_count / 10);
}

TEST_P(FixedText, PrintsWhatTheGeneralPrinterPrints) {
  print_random(kernel(), 7, 30000, 2);
  for (const int decimals : all_decimals()) print_random(kernel(), decimals, 3000, 2);
}

TEST_P(FixedText, LongPrintsWhatTheGeneralPrinterPrintsOnAHundredMillionNumbers) {
  for (const int decimals : all_decimals())
    print_random(kernel(), decimals, (decimals == 7 ? 100'000'000 : 10'000'000) / 9, 3);
}

/// The columns of a text, and room for the numbers of so many triangles.
struct ColumnArrays {
  std::array<std::vector<Triangle>, 3> groups;
  std::vector<std::array<double, 3>> w;

  ColumnArrays(std::size_t group_count, bool has_w, std::size_t triangle_count) {
    for (std::size_t group = 0; group < group_count; ++group) groups[group].resize(triangle_count);
    if (has_w) w.resize(triangle_count);
  }
  [[nodiscard]] FixedColumns columns() { return {{groups[0], groups[1], groups[2]}, w}; }
  [[nodiscard]] ConstFixedColumns columns() const { return {{groups[0], groups[1], groups[2]}, w}; }
};

std::string scene_frame(const std::string& lines) {
  return "triangle\n" + lines;
}

std::vector<std::uint64_t> bits_of(const ColumnArrays& arrays) {
  std::vector<std::uint64_t> bits;
  for (const auto& group : arrays.groups)
    for (const Triangle& triangle : group)
      for (const auto& number : std::bit_cast<std::array<std::uint64_t, 9>>(triangle)) bits.push_back(number);
  for (const auto& three : arrays.w)
    for (const double number : three) bits.push_back(std::bit_cast<std::uint64_t>(number));
  return bits;
}

/// w in the forms that programs print, often with as many decimals.
std::string random_w(std::mt19937_64& random, int decimals) {
  const double w = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 20) - 60);
  std::array<char, 40> text;
  const auto end = random() % 2 == 0
                       ? std::to_chars(text.data(), text.data() + text.size(), w, std::chars_format::fixed,
                                       random() % 2 == 0 ? decimals : static_cast<int>(random() % 15))
                       : std::to_chars(text.data(), text.data() + text.size(), w, std::chars_format::fixed);
  return {text.data(), end.ptr};
}

TEST_P(FixedText, ReadsColumnsAsTheGeneralReaderDoes) {
  std::mt19937_64 random(8);
  for (int i = 0; i < 6000; ++i) {
    const std::size_t group_count = 1 + random() % 3;
    const bool has_w = random() % 2 == 0;
    const auto frame = random() % 2 == 0 ? TriangleFrame::scene : TriangleFrame::stage_text;
    GroupDecimals decimals;
    for (int& count : decimals) count = static_cast<int>(random() % (kMaxFixedDecimals + 1));
    ColumnArrays expected(group_count, has_w, 1);
    std::string lines;
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      for (std::size_t group = 0; group < group_count; ++group) {
        Vec3& numbers = expected.groups[group][0][vertex];
        for (double* const number : {&numbers.x, &numbers.y, &numbers.z}) {
          const std::string word = random_word(random, decimals[group]);
          *number = general_number(word);
          lines += word + " ";
        }
        if (group > 0 || !has_w) continue;
        const std::string word = random_w(random, decimals[0]);
        expected.w[0][vertex] = general_number(word);
        lines += word + " ";
      }
      lines.back() = '\n';
    }
    const std::string text = frame == TriangleFrame::scene ? scene_frame(lines) : lines + "\n";
    ColumnArrays arrays(group_count, has_w, 1);
    const FixedTextPart part = read_columns(text, frame, decimals, arrays.columns());
    // Few w lie too close to the midpoint of two doubles for the fast reader.
    if (has_w && part.triangle_count == 0) continue;
    ASSERT_EQ(part.length, text.size()) << text;
    ASSERT_EQ(bits_of(arrays), bits_of(expected)) << text;
  }
}

constexpr GroupDecimals kDecimals = {1, 0, 2};

/// Calls `check(triangle, frame, group_count)` with the text of a triangle that has these counts of decimals.
template <typename Check>
void for_each_form(const Check& check) {
  constexpr std::array kLines = {"1.5 2.5 3.5\n", "1.5 2.5 3.5 4 5 6\n",
                                 "1.5 2.5 3.5 4 5 6 0.25 0.50 1.00\n"};
  for (std::size_t group_count = 1; group_count <= kLines.size(); ++group_count) {
    const std::string line = kLines[group_count - 1], lines = line + line + line;
    check(scene_frame(lines), TriangleFrame::scene, group_count);
    check(lines + "\n", TriangleFrame::stage_text, group_count);
  }
}

// A triangle with one byte replaced is read only if a digit replaced a digit.
TEST_P(FixedText, EveryByteMatters) {
  const auto is_digit = [](int byte) { return byte >= '0' && byte <= '9'; };
  for_each_form([&](const std::string& triangle, TriangleFrame frame, std::size_t group_count) {
    for (std::size_t i = 0; i < triangle.size(); ++i) {
      for (int byte = 0; byte < 256; ++byte) {
        std::string text = triangle;
        text[i] = static_cast<char>(byte);
        ColumnArrays arrays(group_count, false, 2);
        const bool is_fine = text == triangle || (is_digit(byte) && is_digit(triangle[i]));
        ASSERT_EQ(read_columns(text, frame, kDecimals, arrays.columns()).triangle_count, is_fine ? 1u : 0u)
            << group_count << " " << i << " " << byte;
      }
    }
  });
}

TEST_P(FixedText, ReadsWholeTrianglesAlone) {
  for_each_form([&](const std::string& triangle, TriangleFrame frame, std::size_t group_count) {
    for (std::size_t length = 0; length < triangle.size(); ++length) {
      ColumnArrays arrays(group_count, false, 3);
      const std::string text = triangle + triangle.substr(0, length);
      const FixedTextPart part = read_columns(text, frame, kDecimals, arrays.columns());
      ASSERT_EQ(part.length, triangle.size()) << length;
      ASSERT_EQ(part.triangle_count, 1u) << length;
    }
    ColumnArrays arrays(group_count, false, 2);
    EXPECT_EQ(read_columns(triangle + triangle + triangle, frame, kDecimals, arrays.columns()).length,
              2 * triangle.size());
  });
}

TEST_P(FixedText, LeavesColumnsOfAnyOtherForm) {
  const std::string fine = "1.5 2.5 3.5 2.25 7 8 9\n";
  for (const std::string& line :
       {fine, std::string("1.5 2.5 3.5 2 7 8 9\n"), std::string("1.5 2.5 3.5 1e3 7 8 9\n"),
        std::string("1.5 2.5 3.5 7 8 9\n"), std::string("1.5 2.5 3.5 2.25 7 8\n"),
        std::string("1.5 2.5 3.5 2.25 7 8 9 1\n"), std::string("1.5 2.5 3.5  2.25 7 8 9\n"),
        std::string("1.5 2.5 3.5 2.25\n7 8 9\n"), std::string("1.5 2.5 3.5 2.25 7 8 9 \n"),
        std::string("1.5 2.5 3.5 2.25 7 8 9\r\n"), std::string("1.5 2.5 3.5 +2.25 7 8 9\n"),
        std::string("1.5 2.5 3.5 - 7 8 9\n"), std::string("1.5 2.5 3.5 2.25 7 8 9 # so\n")}) {
    ColumnArrays arrays(2, true, 1);
    const FixedTextPart part =
        read_columns(fine + line + fine + "\n", TriangleFrame::stage_text, {1, 0, 0}, arrays.columns());
    const bool is_fine = line == fine || line == "1.5 2.5 3.5 2 7 8 9\n";
    EXPECT_EQ(part.triangle_count, is_fine ? 1u : 0u) << line;
  }
}

std::string general_columns(const ColumnArrays& arrays, std::size_t triangle, int decimals) {
  std::string text;
  for (std::size_t vertex = 0; vertex < 3; ++vertex) {
    for (const auto& group : arrays.groups) {
      if (group.empty()) continue;
      const Vec3& v = group[triangle][vertex];
      for (const double number : {v.x, v.y, v.z}) text += general_text(number, decimals) + " ";
      if (&group != &arrays.groups[0] || arrays.w.empty()) continue;
      std::array<char, 40> w;
      text.append(w.data(), std::to_chars(w.data(), w.data() + w.size(), arrays.w[triangle][vertex]).ptr);
      text += ' ';
    }
    text.back() = '\n';
  }
  return text + "\n";
}

/// Prints all triangles that the kernel does not leave.
std::string write_columns(WriteFixedColumns write, const ColumnArrays& arrays, int decimals,
                          std::size_t& count) {
  std::string out(arrays.groups[0].size() * kMaxFixedColumnsLength + kFixedTextSlack, '\0');
  const FixedTextPart part = write(arrays.columns(), 0, decimals, out.data());
  count = part.triangle_count;
  out.resize(part.length);
  return out;
}

TEST_P(FixedText, PrintsColumnsAsTheGeneralPrinterDoesOrLeavesThem) {
  std::mt19937_64 random(9);
  for (const int decimals : all_decimals()) {
    const double largest = std::min(300.0, std::pow(10.0, 14 - decimals));
    std::uniform_real_distribution<double> number(-largest, largest);
    std::size_t printed_count = 0;
    for (int i = 0; i < 500; ++i) {
      const std::size_t group_count = 1 + random() % 3;
      ColumnArrays arrays(group_count, random() % 2 == 0, 3);
      for (std::size_t group = 0; group < group_count; ++group)
        for (Triangle& triangle : arrays.groups[group])
          for (Vec3& v : triangle) {  // a number, a whole one, and a tie
            const double tie = std::ldexp(std::round(number(random)), -decimals - 1);
            v = {number(random) / (1 + i), std::round(number(random)), random() % 16 == 0 ? tie : -0.0};
          }
      // Mostly as short as a stage prints them, with zeros at the end or before the first digit.
      for (auto& three : arrays.w)
        for (double& w : three) {
          const double scale = std::pow(10.0, static_cast<int>(random() % (decimals + 1)));
          w = std::round(number(random) * scale / (random() % 2 == 0 ? 1e4 : 1)) / scale + 0.0;
          if (random() % 32 == 0) w = std::ldexp(number(random), static_cast<int>(random() % 80) - 60);
        }
      std::size_t count = 0;
      const std::string text = write_columns(kernel(), arrays, decimals, count);
      std::string expected;
      for (std::size_t k = 0; k < count; ++k) expected += general_columns(arrays, k, decimals);
      ASSERT_EQ(text, expected) << decimals;
      printed_count += count;
    }
    EXPECT_GT(printed_count, 300u) << decimals;
  }
}

// Colors repeat, with breaks in any vertex; the form of a repeated text differs at the end of a line.
TEST_P(FixedText, ReadsAndPrintsRepeatedColumns) {
  std::mt19937_64 random(10);
  constexpr std::size_t kCount = 12;
  const std::array<Vec3, 3> colors = {Vec3{200, 100, 50}, Vec3{200, 100, 50.5}, Vec3{0, 12, -3}};
  for (int i = 0; i < 2000; ++i) {
    ColumnArrays arrays(2 + random() % 2, random() % 2 == 0, kCount);
    for (std::size_t k = 0; k < kCount; ++k)
      for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        arrays.groups[0][k][vertex] = {1, static_cast<double>(random() % 100), 0.5};
        arrays.groups[1][k][vertex] = colors[random() % 8 == 0 ? random() % 3 : 0];
        if (!arrays.groups[2].empty()) arrays.groups[2][k][vertex] = arrays.groups[1][k][vertex];
        if (!arrays.w.empty()) arrays.w[k][vertex] = 1.25;
      }
    std::size_t count = 0;
    const std::string text = write_columns(kernel(), arrays, 2, count);
    std::string expected;
    for (std::size_t k = 0; k < kCount; ++k) expected += general_columns(arrays, k, 2);
    ASSERT_EQ(text, expected);
    ColumnArrays read(arrays.groups[2].empty() ? 2 : 3, !arrays.w.empty(), kCount);
    ASSERT_EQ(read_columns(text, TriangleFrame::stage_text, {2, 2, 2}, read.columns()).triangle_count,
              kCount);
    ASSERT_EQ(bits_of(read), bits_of(arrays));
  }
}

// Four triangles whose corners have the color of the corner before or another one: two others in a row end
// the search for repeated colors, in any triangle and at any corner. Zeros of either sign are the same color.
TEST_P(FixedText, ReadsAndPrintsColumnsInEveryPatternOfRepetition) {
  constexpr std::size_t kCount = 4, kCorners = 3 * kCount;
  for (unsigned pattern = 0; pattern < 1u << (kCorners - 1); ++pattern) {
    ColumnArrays arrays(2, false, kCount), with_signs(2, false, kCount);
    double color = 1;
    for (std::size_t i = 0; i < kCorners; ++i) {
      if (i > 0 && (pattern >> (i - 1) & 1) == 0) ++color;
      const auto x = static_cast<double>(i);
      arrays.groups[0][i / 3][i % 3] = with_signs.groups[0][i / 3][i % 3] = {x, 0.25, -0.5};
      arrays.groups[1][i / 3][i % 3] = {0, 100, color};
      with_signs.groups[1][i / 3][i % 3] = {i % 2 == 0 ? 0.0 : -0.0, 100, color};
    }
    std::string expected;
    for (std::size_t k = 0; k < kCount; ++k) expected += general_columns(arrays, k, 2);
    std::size_t count = 0;
    ASSERT_EQ(write_columns(kernel(), with_signs, 2, count), expected) << pattern;
    ASSERT_EQ(count, kCount);
    ColumnArrays read(2, false, kCount);
    ASSERT_EQ(read_columns(expected, TriangleFrame::stage_text, {2, 2, 2}, read.columns()).triangle_count,
              kCount);
    ASSERT_EQ(bits_of(read), bits_of(arrays)) << pattern;
  }
}

const std::string kWithMaterials =
    "0.5 1.0 2.0 7\n-3.0 4.0 5.0 7\n6.0 7.0 8.0 7\n\n"
    "1.0 1.0 1.0 12345678\n2.0 2.0 2.0 12345678\n3.0 3.0 3.0 12345678\n\n";

TEST_P(FixedText, ReadsAndPrintsMaterials) {
  std::vector<Triangle> triangles(3);
  std::vector<std::uint32_t> materials(3);
  const FixedTextPart read =
      read_columns(kWithMaterials, TriangleFrame::stage_text, {1}, {{triangles}, {}, materials});
  EXPECT_EQ(read.length, kWithMaterials.size());
  ASSERT_EQ(read.triangle_count, 2u);
  EXPECT_EQ(triangles[0][1], (Vec3{-3, 4, 5}));
  EXPECT_EQ(materials, (std::vector<std::uint32_t>{7, 12345678, 0}));
  materials[2] = 4294967295;
  std::string out(3 * kMaxFixedColumnsLength + kFixedTextSlack, '\0');
  const FixedTextPart written = kernel()({{triangles}, {}, materials}, 0, 1, out.data());
  const std::string last = "0.0 0.0 0.0 4294967295\n";
  EXPECT_EQ(out.substr(0, written.length), kWithMaterials + last + last + last + "\n");
}

TEST_P(FixedText, LeavesMaterialsInAnyOtherForm) {
  const std::string good = "1 1 1 2\n2 2 2 2\n3 3 3 2\n\n";
  for (const char* const line :
       {"3 3 3 1", "3 3 3 2 ", "3 3 3 2\r", "3 3 3 -2", "3 3 3 2.0", "3 3 3 +2", "3 3 3 2e0", "3 3 3\t2",
        "3 3 3 1000000002", "3 3 3 4294967298", "3 3 3 ", "3 3 3", "2", "", "2 #2"}) {
    std::vector<Triangle> triangles(3);
    std::vector<std::uint32_t> materials(3);
    const std::string text = good + "1 1 1 2\n2 2 2 2\n" + line + "\n\n" + good;
    const FixedTextPart part =
        read_columns(text, TriangleFrame::stage_text, {0}, {{triangles}, {}, materials});
    EXPECT_EQ(part.triangle_count, 1u) << line;
    EXPECT_EQ(part.length, good.size()) << line;
  }
}

TEST_P(FixedText, StopsBeforeTheFirstColumnsItCannotPrint) {
  for (const double value : {1e17, HUGE_VAL, std::nan("")})
    for (std::size_t group = 0; group < 3; ++group) {
      ColumnArrays arrays(3, true, 4);
      arrays.groups[group][2][1].y = value;
      std::size_t count = 0;
      EXPECT_EQ(write_columns(kernel(), arrays, 7, count),
                general_columns(arrays, 0, 7) + general_columns(arrays, 1, 7));
      EXPECT_EQ(count, 2u);
    }
}

TEST_P(FixedText, HasRoomForTheLongestColumns) {
  ColumnArrays arrays(3, true, 1);
  constexpr double kLongest = -99999999.9999999;
  constexpr Vec3 kThree = {kLongest, kLongest, kLongest};
  for (auto& group : arrays.groups) group[0] = {kThree, kThree, kThree};
  const double longest_w = -std::nextafter(0x1p-1022, 1);
  arrays.w[0] = {longest_w, longest_w, longest_w};
  std::size_t count = 0;
  const std::string text = write_columns(kernel(), arrays, 7, count);
  EXPECT_EQ(text, general_columns(arrays, 0, 7));
  EXPECT_LE(text.size(), kMaxFixedColumnsLength);
}

TEST(FixedTextDecimals, AreThoseOfTheFirstNumber) {
  const auto decimals_of = [](std::string text) {
    return decimals_of_number((text += std::string(30, '7')).data());
  };
  EXPECT_EQ(decimals_of("1.25 0.123 3\n"), 2);
  EXPECT_EQ(decimals_of("-1.0000000 0.123 3\n"), 7);
  EXPECT_EQ(decimals_of("12345678.12345678 3\n"), 8);
  EXPECT_EQ(decimals_of("12 0.123 3\n"), 0);
  EXPECT_EQ(decimals_of("12\n0.123\n"), 0);
  EXPECT_EQ(decimals_of("0.12345678901234 1"), 14);
  EXPECT_EQ(decimals_of("0.123456789012345678901234567890 1"), 14);
  EXPECT_EQ(decimals_of("1. 3"), 0);
  EXPECT_EQ(decimals_of("\n"), 0);
  EXPECT_EQ(decimals_of("# 1.5\n"), 0);
}

std::vector<std::size_t> printing_targets() {
  std::vector<std::size_t> targets = testable_targets(kFixedPrintingKernels);
  targets.erase(targets.begin());
  return targets;
}

INSTANTIATE_TEST_SUITE_P(Kernels, FixedText, testing::ValuesIn(printing_targets()), name_of_target);

}  // namespace
}  // namespace pipeline
