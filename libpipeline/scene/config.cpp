#include "libpipeline/scene/config.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>

#include "libpipeline/numbers/double_double.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

LineScanner required_line(TextReader& text, const std::string& expected) {
  LineScanner line;
  text.expect_filled_line(line, expected);
  return line;
}

bool is_size(std::uint64_t size) {
  return size >= 1 && size <= kMaxViewportSize;
}

// The readers below take a word from a copy of the line, so that the line itself can report a word that is
// out of range.

int read_size(LineScanner& line, const std::string& name) {
  const std::string expected = "the " + name + " in pixels, a whole number from 1 to 65535";
  if (const auto both = parse_size(line.peek()))
    line.fail(expected, " (write " + std::to_string(both->columns) + " " + std::to_string(both->rows) + ")");
  LineScanner ahead = line;
  const std::uint64_t size = ahead.count(expected);
  if (!is_size(size)) line.fail(expected);
  line = ahead;
  return static_cast<int>(size);
}

/// Reads the line of a limit, left or bottom; its negation is the opposite limit. Returns its value, its low
/// part, and whether it is a decimal.
std::tuple<double, double, bool> read_negative_limit(const LineScanner& line, const std::string& name) {
  LineScanner ahead = line;
  const double limit = ahead.number("the " + name + ", a negative number");
  if (limit >= 0) line.fail("the " + name + ", a negative number");
  if (-limit < kMinLimit || -limit > kMaxLimit)
    line.fail("the " + name + ", a number from -1e200 to -1e-200");
  ahead.expect_end("the " + name);
  DoubleDouble exact;
  if (!parse_exact_decimal(line.peek(), exact)) return {limit, 0, false};
  return {exact.hi, exact.lo, true};
}

void read_depth_limits(LineScanner line, Viewport& viewport) {
  const std::string expected_rear = "the rear limit of Z, a number greater than the front limit";
  viewport.front = line.number("the front limit of Z");
  LineScanner ahead = line;
  viewport.rear = ahead.number(expected_rear);
  if (viewport.rear <= viewport.front) line.fail(expected_rear);
  ahead.expect_end("the rear limit of Z");
}

}  // namespace

std::optional<std::pair<std::uint64_t, std::uint64_t>> parse_pair(std::string_view word, char separator) {
  const std::size_t end = std::min(word.find(separator), word.size());
  std::pair<std::uint64_t, std::uint64_t> pair;
  if (!parse_count(word.substr(0, end), pair.first) ||
      !parse_count(word.substr(std::min(end + 1, word.size())), pair.second))
    return std::nullopt;
  return pair;
}

std::optional<Viewport> parse_size(std::string_view word) {
  const auto size = parse_pair(word, 'x');
  if (!size || !is_size(size->first) || !is_size(size->second)) return std::nullopt;
  Viewport viewport;
  viewport.columns = static_cast<int>(size->first);
  viewport.rows = static_cast<int>(size->second);
  return viewport;
}

// C1, C2, C3
Viewport read_config(TextReader& text) {
  Viewport viewport;
  LineScanner line = required_line(text, "the width and height in pixels");
  viewport.columns = read_size(line, "width");
  viewport.rows = read_size(line, "height");
  line.expect_end("the height");
  // Width and height alone are a complete config.
  if (!text.next_filled_line(line)) return viewport;
  std::tie(viewport.left, viewport.left_low_part, viewport.left_is_decimal) =
      read_negative_limit(line, "left limit of X");
  std::tie(viewport.bottom, viewport.bottom_low_part, viewport.bottom_is_decimal) =
      read_negative_limit(required_line(text, "the bottom limit of Y"), "bottom limit of Y");
  read_depth_limits(required_line(text, "the front and rear limits of Z"), viewport);
  if (text.next_filled_line(line)) line.fail("nothing after the limits of Z");
  return viewport;
}

}  // namespace pipeline
