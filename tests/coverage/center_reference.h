#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "libpipeline/coverage/center.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {

/// A triangle given by its text.
struct TextTriangle {
  Triangle p;
  Triangle low_parts{};
  std::uint16_t decimal_marks = 0;

  [[nodiscard]] ExactTriangle exact() const { return {p, &low_parts, decimal_marks}; }
};

/// The words, separated by blanks.
inline std::string joined(std::initializer_list<std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) {
    if (!text.empty()) text += ' ';
    text += word;
  }
  return text;
}

/// The triangle written as "x y z x y z x y z".
inline TextTriangle triangle_of(std::string_view text) {
  constexpr std::array kAxes = {&Vec3::x, &Vec3::y, &Vec3::z};
  TextTriangle t;
  for (std::size_t i = 0; i < 9; ++i) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    DoubleDouble decimal;
    t.p[i / 3].*kAxes[i % 3] = parse_number(word).value;
    if (!parse_exact_decimal(word, decimal)) continue;
    t.low_parts[i / 3].*kAxes[i % 3] = decimal.lo;
    t.decimal_marks |= static_cast<std::uint16_t>(1u << i);
  }
  return t;
}

/// x and y of three vertices in units of 10^-7.
using UnitTriangle = std::array<std::array<std::int64_t, 2>, 3>;

inline TextTriangle triangle_of(const UnitTriangle& units, std::array<double, 3> z = {0, 0, 0}) {
  TextTriangle t;
  for (std::size_t i = 0; i < 3; ++i)
    t.p[i] = {static_cast<double>(units[i][0]) / 1e7, static_cast<double>(units[i][1]) / 1e7, z[i]};
  t.decimal_marks = 0x1ff;
  return t;
}

inline Viewport decimal_screen(int columns, int rows, double left = -1, double bottom = -1) {
  Viewport screen = {columns, rows, left, bottom, -1, 1};
  screen.left_is_decimal = screen.bottom_is_decimal = true;
  return screen;
}

template <typename Rows>
std::vector<Span> spans_of(const Rows& rows) {
  std::vector<Span> spans;
  for_each_span(rows, [&](const Span& span) { spans.push_back(span); });
  return spans;
}

/// The count of triangles that own each pixel, row after row.
class Owners {
 public:
  explicit Owners(const Viewport& screen)
      : grid_(screen),
        screen_(screen),
        counts_(static_cast<std::size_t>(screen.columns) * static_cast<std::size_t>(screen.rows)) {}

  void add(const TextTriangle& triangle) {
    for (const Span& span : spans_of(CenterRows(grid_, triangle.exact())))
      for (int column = span.first_column; column <= span.last_column; ++column) ++at(span.row, column);
  }
  [[nodiscard]] int count(int row, int column) const { return counts_[index(row, column)]; }
  /// The number of pixels with this many owners.
  [[nodiscard]] long pixels_with(int owner_count) const {
    return std::count(counts_.begin(), counts_.end(), owner_count);
  }
  [[nodiscard]] long all() const { return static_cast<long>(counts_.size()); }
  /// A line for each row: '.' for no owner, '#' for one, else the count.
  [[nodiscard]] std::vector<std::string> picture() const {
    std::vector<std::string> lines(static_cast<std::size_t>(screen_.rows));
    for (std::size_t i = 0; i < counts_.size(); ++i)
      lines[i / static_cast<std::size_t>(screen_.columns)] +=
          counts_[i] < 2 ? ".#"[counts_[i]] : static_cast<char>('0' + counts_[i]);
    return lines;
  }

 private:
  [[nodiscard]] std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(screen_.columns) +
           static_cast<std::size_t>(column);
  }
  int& at(int row, int column) { return counts_.at(index(row, column)); }

  ExactGrid grid_;
  Viewport screen_;
  std::vector<int> counts_;
};

}  // namespace pipeline
