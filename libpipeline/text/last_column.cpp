#include "libpipeline/text/last_column.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "libpipeline/text/fixed_text.h"

namespace pipeline {
namespace {

constexpr std::size_t kMaxDigits = 9;  // so that 32 bits hold the number

/// The last word of a line, if that is a whole number after a blank.
struct LastNumber {
  std::uint32_t value = 0;
  std::size_t begin = 0;  // the position of its first digit; 0 if there is no such number
};

LastNumber last_number(std::string_view line) {
  LastNumber number;
  std::size_t begin = line.size();
  std::uint32_t factor = 1;
  while (begin > 0 && line.size() - begin < kMaxDigits && line[begin - 1] >= '0' && line[begin - 1] <= '9') {
    number.value += static_cast<std::uint32_t>(line[--begin] - '0') * factor;
    factor *= 10;
  }
  if (begin > 0 && begin < line.size() && line[begin - 1] == ' ') number.begin = begin;
  return number;
}

}  // namespace

TrianglesWithoutLastColumn::TrianglesWithoutLastColumn(std::string_view text, std::size_t limit,
                                                       std::size_t bound) {
  while (count() < limit && take(text, bound)) {
  }
  length_ = lines_.size();
  lines_.append(kFixedTextSlack, '\0');
}

bool TrianglesWithoutLastColumn::take(std::string_view text, std::size_t bound) {
  const std::size_t old_length = lines_.size();
  std::size_t begin = length_with_column(count());
  std::uint32_t value = 0;
  const auto take_line = [&](std::size_t vertex) {
    const std::size_t end = text.find('\n', begin);
    if (end == std::string_view::npos) return false;
    const std::string_view line = text.substr(begin, end - begin);
    const LastNumber number = last_number(line);
    if (number.begin == 0 || number.value >= bound || (vertex > 0 && number.value != value)) return false;
    value = number.value;
    lines_.append(line.substr(0, number.begin - 1)).push_back('\n');
    begin = end + 1;
    return true;
  };
  if (!take_line(0) || !take_line(1) || !take_line(2) || begin == text.size() || text[begin] != '\n') {
    lines_.resize(old_length);
    return false;
  }
  lines_.push_back('\n');
  values_.push_back(value);
  ends_.push_back(begin + 1);
  return true;
}

char* print_with_last_column(std::string_view lines, std::span<const std::uint32_t> values, char* out) {
  for (const std::uint32_t value : values) {
    std::array<char, kMaxLastColumnLength / 3> column;
    column[0] = ' ';
    char* const end = std::to_chars(column.data() + 1, column.data() + column.size(), value).ptr;
    const auto column_length = static_cast<std::size_t>(end - column.data());
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      const std::size_t length = lines.find('\n');
      out = std::copy_n(lines.begin(), length, out);
      out = std::copy_n(column.begin(), column_length, out);
      *out++ = '\n';
      lines.remove_prefix(length + 1);
    }
    *out++ = '\n';
    lines.remove_prefix(1);
  }
  return out;
}

}  // namespace pipeline
