#include "libpipeline/text/fixed_text.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <string>
#include <vector>

#include "tests/numbers/random_numbers.h"

namespace pipeline {
namespace {

/// Room for the numbers of triangles with so many groups of columns.
struct Columns {
  std::array<std::vector<Triangle>, 3> groups;
  std::vector<std::array<double, 3>> w;
  std::vector<std::uint32_t> materials;
  std::vector<DecimalMarks> marks;

  Columns(std::size_t group_count, bool has_w, std::size_t triangle_count) : marks(triangle_count) {
    for (std::size_t group = 0; group < group_count; ++group) groups[group].resize(triangle_count);
    if (has_w) w.resize(triangle_count);
  }
  /// As the codec takes them.
  template <typename Of, typename Arrays>
  static Of of(Arrays& arrays) {
    return {{arrays.groups[0], arrays.groups[1], arrays.groups[2]}, arrays.w, arrays.materials};
  }
  /// Calls `visit(number)` for every number of a triangle, in the order of the text; then `end_line()`.
  template <typename Visit, typename EndLine>
  void for_each_number(std::size_t triangle, const Visit& visit, const EndLine& end_line) {
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      for (auto& group : groups) {
        if (group.empty()) continue;
        for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z}) visit(group[triangle][vertex].*axis);
        if (&group == &groups[0] && !w.empty()) visit(w[triangle][vertex]);
      }
      end_line();
    }
  }
};

FixedTextPart read(const std::string& text, Columns& columns,
                   TriangleFrame frame = TriangleFrame::stage_text) {
  const std::string with_slack = text + std::string(kFixedTextSlack, '7');
  return read_columns({with_slack.data(), text.size()}, frame, Columns::of<FixedColumns>(columns),
                      columns.marks);
}

std::string written(const Columns& columns, NumberFormat format = kShortest,
                    const Triangle* low_part = nullptr) {
  TextWriter text;
  write_columns(Columns::of<ConstFixedColumns>(columns), low_part, format, text);
  return std::string(text.collected());
}

std::string shortest(double value) {
  std::array<char, 40> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value == 0 ? 0.0 : value).ptr};
}

/// A decimal of up to 17 digits without an exponent, as programs print them.
std::string random_word(RandomNumbers& random) {
  std::array<char, 60> text;
  const double value = random.with_exponent(-8, 20);
  char* const end = text.data() + text.size();
  const int kind = random.whole(0, 3);
  const auto printed =
      kind == 0 ? std::to_chars(text.data(), end, value, std::chars_format::fixed, random.whole(0, 12))
                : std::to_chars(text.data(), end, value, std::chars_format::fixed);
  return {text.data(), printed.ptr};
}

TEST(ColumnCodec, ReadsAsTheGeneralReaderDoes) {
  RandomNumbers random(1);
  int read_count = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto frame = i % 2 == 0 ? TriangleFrame::stage_text : TriangleFrame::scene;
    Columns expected(1 + static_cast<std::size_t>(random.whole(0, 2)), random.whole(0, 1) == 0, 1);
    std::string lines;
    std::vector<int> decimals;
    expected.for_each_number(
        0,
        [&](double& number) {
          const std::string word = random_word(random);
          std::from_chars(word.data(), word.data() + word.size(), number);
          const std::size_t point = word.find('.');
          decimals.push_back(point == std::string::npos ? 0 : static_cast<int>(word.size() - point - 1));
          lines += word + " ";
        },
        [&] { lines.back() = '\n'; });
    const std::string text = frame == TriangleFrame::scene ? "triangle\n" + lines : lines + "\n";
    Columns columns(1, !expected.w.empty(), 1);
    for (std::size_t group = 1; group < 3; ++group)
      columns.groups[group].resize(expected.groups[group].size());
    const FixedTextPart part = read(text, columns, frame);
    // Few numbers lie so close to the midpoint of two doubles that only the general reader has them.
    if (part.triangle_count == 0) continue;
    ++read_count;
    ASSERT_EQ(part.length, text.size()) << text;
    for (std::size_t group = 0; group < 3; ++group)
      ASSERT_EQ(columns.groups[group], expected.groups[group]) << text;
    ASSERT_EQ(columns.w, expected.w) << text;
    const std::size_t line_length = decimals.size() / 3;
    for (std::size_t k = 0; k < 9; ++k)
      ASSERT_EQ((columns.marks[0] >> k & 1) == 1, decimals[k / 3 * line_length + k % 3] <= 7) << text << k;
  }
  EXPECT_GT(read_count, 19'900);
}

// Some of them begin alike, where lines are looked up by their first characters.
TEST(ColumnCodec, ReadsLinesThatTrianglesShare) {
  struct Line {
    std::string text;
    Vec3 position, normal;
    unsigned marks;
  };
  const std::array<Line, 5> lines = {
      {{"1.5 -2 0.123456789 0 1 0.5\n", {1.5, -2, 0.123456789}, {0, 1, 0.5}, 3},
       {"1.5 -2 0.123456788 0 1 0.5\n", {1.5, -2, 0.123456788}, {0, 1, 0.5}, 3},
       {"1.5 -2 0.123456788 0 1 0.25\n", {1.5, -2, 0.123456788}, {0, 1, 0.25}, 3},
       {"1.5 -2 0.125 0 1 0.5\n", {1.5, -2, 0.125}, {0, 1, 0.5}, 7},
       {"0.00000001 7 1.234567890123 0 0 -1\n", {0.00000001, 7, 1.234567890123}, {0, 0, -1}, 2}}};
  RandomNumbers random(4);
  std::string text;
  std::vector<const Line*> chosen;
  for (int i = 0; i < 300; ++i) {
    chosen.push_back(&lines[static_cast<std::size_t>(random.whole(0, 4))]);
    text += (i % 3 == 0 ? "triangle\n" : "") + chosen.back()->text;
  }
  Columns columns(2, false, 100);
  ASSERT_EQ(read(text, columns, TriangleFrame::scene).triangle_count, 100u);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    ASSERT_EQ(columns.groups[0][i / 3][i % 3], chosen[i]->position) << i;
    ASSERT_EQ(columns.groups[1][i / 3][i % 3], chosen[i]->normal) << i;
    ASSERT_EQ(columns.marks[i / 3] >> 3 * (i % 3) & 7u, chosen[i]->marks) << i;
  }
}

const std::string kLine = "1.5 -2 0.123456789 0.25 255 0 9.5\n";

TEST(ColumnCodec, ReadsWholeTrianglesAlone) {
  for (const auto frame : {TriangleFrame::stage_text, TriangleFrame::scene}) {
    const std::string lines = kLine + kLine + kLine;
    const std::string triangle = frame == TriangleFrame::scene ? "triangle\n" + lines : lines + "\n";
    for (std::size_t length = 0; length < triangle.size(); ++length) {
      Columns columns(2, true, 3);
      const FixedTextPart part = read(triangle + triangle.substr(0, length), columns, frame);
      ASSERT_EQ(part.triangle_count, 1u) << length;
      ASSERT_EQ(part.length, triangle.size()) << length;
    }
    Columns columns(2, true, 2);
    EXPECT_EQ(read(triangle + triangle + triangle, columns, frame).triangle_count, 2u);
  }
}

TEST(ColumnCodec, LeavesAnyOtherForm) {
  for (const std::string line :
       {"1.5 -2 0.1 0.25 255 0\n", "1.5 -2 0.1 0.25 255 0 9.5 1\n", "1.5  -2 0.1 0.25 255 0 9.5\n",
        " 1.5 -2 0.1 0.25 255 0 9.5\n", "1.5 -2 0.1 0.25 255 0 9.5 \n", "1.5 -2 0.1 0.25 255 0 9.5\r\n",
        "1.5 -2 0.1 0.25 255 0 9.5 # so\n", "1.5 -2 0.1 1e3 255 0 9.5\n", "1.5 -2 0.1 0.25 255 0 1e3\n",
        "1.5 -2 0.1 0.25 255 0 nan\n", "1.5 -2 0.1\t0.25 255 0 9.5\n", "1.5 -2 0.1 0.25 255 0 -\n", "\n"}) {
    Columns columns(2, true, 1);
    EXPECT_EQ(read(kLine + line + kLine + "\n", columns).triangle_count, 0u) << line;
  }
}

TEST(ColumnCodec, ReadsAndPrintsMaterials) {
  const std::string line = "1.5 -2 0.125 3 7\n", text = line + line + line + "\n";
  Columns columns(1, true, 1);
  columns.materials.resize(1);
  EXPECT_EQ(read(text, columns).length, text.size());
  EXPECT_EQ(columns.w[0][2], 3);
  EXPECT_EQ(columns.materials[0], 7u);
  EXPECT_EQ(written(columns), text);
  for (const std::string last : {"1.5 -2 0.125 3 8\n", "1.5 -2 0.125 3 7 \n", "1.5 -2 0.125 3\n"})
    EXPECT_EQ(read(line + line + last + "\n", columns).triangle_count, 0u) << last;
}

TEST(ColumnCodec, PrintsTheShortestFormOfToChars) {
  RandomNumbers random(2);
  for (int i = 0; i < 5'000; ++i) {
    Columns columns(1 + static_cast<std::size_t>(random.whole(0, 2)), random.whole(0, 1) == 0, 2);
    std::string expected;
    for (std::size_t triangle = 0; triangle < 2; ++triangle) {
      columns.for_each_number(
          triangle,
          [&](double& number) {
            number = random.whole(0, 9) == 0 ? random.any_double() : random.with_exponent(-20, 20);
            expected += shortest(number) + " ";
          },
          [&] { expected.back() = '\n'; });
      expected += '\n';
    }
    ASSERT_EQ(written(columns), expected);
  }
}

TEST(ColumnCodec, TellsTheDecimalsOfTheFixedForm) {
  const std::string line = "1.50 -2.25 12.00 7 8 9\n", odd = "1.50 -2.25 12.12345678 7 8 9\n";
  for (const auto frame : {TriangleFrame::stage_text, TriangleFrame::scene}) {
    const auto triangle = [&](const std::string& last) {
      const std::string lines = line + line + last;
      return frame == TriangleFrame::scene ? "triangle\n" + lines : lines + "\n";
    };
    Columns columns(2, false, 3);
    const FixedTextPart fixed = read(triangle(line) + triangle(line) + triangle(odd), columns, frame);
    EXPECT_EQ(fixed.triangle_count, 2u);
    EXPECT_EQ(fixed.decimals, 2);
    const FixedTextPart other =
        read(triangle(odd) + triangle(line) + triangle("1e1 1 1 7 8 9\n"), columns, frame);
    EXPECT_EQ(other.triangle_count, 2u);
    EXPECT_EQ(other.decimals, std::nullopt);
    EXPECT_EQ(columns.marks[0], 0xff);
    EXPECT_EQ(columns.marks[1], 0x1ff);
  }
}

TEST(ColumnCodec, PrintsNumberByNumberWhereTheFixedPrinterStops) {
  Columns columns(1, true, 3);
  columns.groups[0][1][2].z = 1e17;
  columns.w[1][2] = 0.25;
  const std::string line = "0.000 0.000 0.000 0\n", triangle = line + line + line + "\n";
  EXPECT_EQ(written(columns, {.decimals = 3}),
            triangle + line + line + "0.000 0.000 100000000000000000.000 0.25\n\n" + triangle);
}

TEST(ColumnCodec, PrintsMoreDecimalsThanADoubleHolds) {
  Columns columns(1, false, 1);
  columns.groups[0][0][1] = {1e16, -0.5, 0};
  const Triangle low_part = {{{}, {0.0625, 0, 0}, {}}};
  EXPECT_EQ(written(columns, {.decimals = 4}, &low_part),
            "0.0000 0.0000 0.0000\n10000000000000000.0625 -0.5000 0.0000\n0.0000 0.0000 0.0000\n\n");
  columns.groups[0][0][1] = {0.25, -0.5, 0};
  const std::string zero = "0.0000000000000000";
  EXPECT_EQ(written(columns, {.decimals = 16}), zero + " " + zero + " " + zero +
                                                    "\n0.2500000000000000 -0.5000000000000000 " + zero +
                                                    "\n" + zero + " " + zero + " " + zero + "\n\n");
}

}  // namespace
}  // namespace pipeline
