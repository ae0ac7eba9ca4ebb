#include "libpipeline/stream/triangle_reader.h"

#include <algorithm>
#include <array>
#include <span>

#include "libpipeline/stream/stage_text.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

constexpr std::uint16_t kAllDecimal = 0x1ff;

/// The marks of the coordinates that are exact decimals, as in a batch: with at most eight digits before the
/// point, those with at most kExactDecimals after it.
std::uint16_t decimal_marks(const DecimalVertexLines& lines) {
  unsigned marks = 0;
  for (std::size_t i = 0; i < 9; ++i)
    if (lines[i / 3].numbers[i % 3].decimals <= kExactDecimals) marks |= 1u << i;
  return static_cast<std::uint16_t>(marks);
}

/// The marks and low parts of a triangle's coordinates, as in a batch.
struct ExactParts {
  std::uint16_t marks = 0;
  Triangle low_parts{};

  /// Adds the vertex on `line`; a word that is not a number is ignored here; the reader reports it.
  void add_vertex(LineScanner line, std::size_t vertex) {
    constexpr std::array<double Vec3::*, 3> kAxes = {&Vec3::x, &Vec3::y, &Vec3::z};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      DoubleDouble value;
      const std::string_view word = line.word();
      if (parse_number(word).error != NumberError::none || !parse_exact_decimal(word, value)) continue;
      marks |= static_cast<std::uint16_t>(1u << (3 * vertex + axis));
      low_parts[vertex].*kAxes[axis] = value.lo;
    }
  }

  /// Stores them for the batch's last triangle.
  void set_last(TriangleBatch& batch) const {
    batch.decimal_marks.resize(batch.size());
    batch.decimal_marks.back() = marks;
    if (low_parts == Triangle{} && batch.low_parts.empty()) return;
    batch.low_parts.resize(batch.size());
    batch.low_parts.back() = low_parts;
  }
};

}  // namespace

TriangleReader::TriangleReader(TextReader& text, const VertexLineReader& vertex_line, bool marks_decimals)
    : text_(text), vertex_line_(vertex_line), marks_decimals_(marks_decimals) {}

bool TriangleReader::read_buffered(TriangleBatch& batch) {
  return read_fixed_form(batch) || read_decimal_form(batch) || read_decimal_lines(batch);
}

/// Takes buffered triangles as long as they have the fixed form; false if the next has another form, or is
/// not completely buffered.
bool TriangleReader::read_fixed_form(TriangleBatch& batch) {
  static_assert(TextReader::kSlack >= kFixedTextSlack);
  constexpr std::size_t kMaxAtOnce = 24;
  if (batch.size() >= kBatchSize) return false;
  // The blank line after a triangle that the general path has read.
  if (text_.buffered().starts_with('\n')) text_.skip(1, 1);
  const std::size_t limit = std::min(kBatchSize - batch.size(), kMaxAtOnce);
  const FixedTextPart part = vertex_line_.read_fixed(text_.buffered(), TriangleFrame::stage_text, limit,
                                                     batch.triangles, batch.attributes);
  consume_fixed_form(part.length, decimals_of_number(text_.buffered().data()), batch);
  return part.triangle_count > 0;
}

void TriangleReader::consume_fixed_form(std::size_t length, int decimals, TriangleBatch& batch) {
  constexpr std::size_t kLinesPerTriangle = 4;
  const std::size_t old_size = batch.numbers.size();
  const std::size_t count = batch.size() - old_size;
  batch.complete(next_number_, text_.line_number() + 1);
  next_number_ += count;
  if (keeps_text_) batch.texts.add_fixed_form(text_.buffered().substr(0, length), decimals);
  text_.skip(length, count * kLinesPerTriangle);
  // With at most seven decimals and eight digits before the point, every coordinate is exactly its decimal.
  if (marks_decimals_) {
    batch.decimal_marks.resize(old_size);
    batch.decimal_marks.resize(batch.size(), decimals <= kExactDecimals ? kAllDecimal : std::uint16_t{0});
  }
}

/// Takes some of the buffered triangles, as long as they have the form of decimal_columns.h; false if the
/// next does not. After a few, the faster form is worth another try.
bool TriangleReader::read_decimal_form(TriangleBatch& batch) {
  std::array<DecimalMarks, 24> marks;
  const std::size_t old_size = batch.size();
  const std::size_t limit = std::min(kBatchSize - std::min(kBatchSize, old_size), marks.size());
  const FixedTextPart part =
      vertex_line_.read_decimals(text_.buffered(), TriangleFrame::stage_text, std::span(marks).first(limit),
                                 batch.triangles, batch.attributes);
  consume_fixed_form(part.length, 0, batch);
  if (marks_decimals_)
    std::copy_n(marks.begin(), part.triangle_count, batch.decimal_marks.begin() + old_size);
  return part.triangle_count > 0;
}

/// The same for lines that hold such numbers and any blanks.
bool TriangleReader::read_decimal_lines(TriangleBatch& batch) {
  constexpr std::size_t kMaxAtOnce = 32;
  const std::size_t limit = std::min(kBatchSize, batch.size() + kMaxAtOnce);
  const std::size_t old_size = batch.size();
  while (batch.size() < limit && read_decimal_triangle(batch)) {
  }
  return batch.size() > old_size;
}

bool TriangleReader::read_decimal_triangle(TriangleBatch& batch) {
  static_assert(TextReader::kSlack >= kDecimalNumberSlack);
  if (text_.buffered().starts_with('\n')) text_.skip(1, 1);
  const std::string_view buffered = text_.buffered();
  DecimalVertexLines& lines = decimal_lines_;
  const char* const end =
      vertex_line_.read_decimals(buffered.data(), buffered.data() + buffered.size(), lines);
  if (end == nullptr) return false;
  TriangleLines values;
  for (std::size_t i = 0; i < 3; ++i)
    values.vertices[i] = to_vertex_line(lines[i], vertex_line_.attributes());
  const auto& [a, b, c] = values.vertices;
  batch.add({a.position, b.position, c.position}, next_number_++,
            locations_of(lines, text_.line_number() + 1));
  batch.attributes.add(values, vertex_line_.attributes());
  if (marks_decimals_) {
    batch.decimal_marks.resize(batch.size());
    batch.decimal_marks.back() = decimal_marks(lines);
  }
  const auto length = static_cast<std::size_t>(end - buffered.data());
  if (keeps_text_) {
    batch.texts.add_trimmed(buffered.substr(0, length));
    batch.texts.end_triangle();
  }
  text_.skip(length, 3);
  return true;
}

void TriangleReader::read_number(LineScanner& line) {
  line.word();
  next_number_ = line.count("the number of a triangle, a whole number below 2^64");
  line.expect_end("the number of a triangle");
}

void TriangleReader::read(LineScanner& line, TriangleBatch& batch) {
  Triangle triangle;
  VertexLocations locations;
  ExactParts exact;
  TriangleLines lines;
  const AttributeSet& attributes = vertex_line_.attributes();
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) next_vertex_line(text_, line, i);
    locations[i] = {line.line_number(), line.column()};
    if (marks_decimals_) exact.add_vertex(line, i);
    if (keeps_text_) batch.texts.add_line(line.rest());
    if (attributes.any()) {
      vertex_line_.read(line, i, lines);
      triangle[i] = lines.vertices[i].position;
    } else {
      triangle[i] = line.vec3(kVertexNames[i]);
    }
  }
  batch.add(triangle, next_number_++, locations);
  batch.attributes.add(lines, attributes);
  if (marks_decimals_) exact.set_last(batch);
  if (keeps_text_) batch.texts.end_triangle();
}

void next_vertex_line(TextReader& text, LineScanner& line, std::size_t index) {
  next_line_within("a triangle", text, line, std::string(kVertexNames[index]));
}

void next_line_within(std::string_view object, TextReader& text, LineScanner& line,
                      const std::string& expected) {
  do {
    if (!text.next_line(line))
      throw InputError(text.end_location(),
                       expected_but_found(expected, "the end of the input inside " + std::string(object)));
    if (line.at_end() && !line.is_comment())
      throw InputError(line.location(),
                       expected_but_found(expected, "a blank line inside " + std::string(object)));
  } while (line.at_end());
  if (line.peek() == "error") throw earlier_failure(line);
}

}  // namespace pipeline
