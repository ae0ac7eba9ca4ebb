#include "libpipeline/stream/triangle_reader.h"

#include <algorithm>

#include "libpipeline/stream/stage_text.h"
#include "libpipeline/text/fixed_text.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

constexpr std::uint16_t kAllDecimal = 0x1ff;

/// The marks and low parts of a triangle's coordinates, as in a batch.
struct ExactParts {
  std::uint16_t marks = 0;
  Triangle low_parts{};

  /// Adds the vertex on `line`; ignores a word that is not a number: the reader reports it.
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

TriangleReader::TriangleReader(TextReader& text, const AttributeSet& columns, std::size_t material_count,
                               bool marks_decimals)
    : text_(text),
      vertex_line_(columns, RangeOfW::above_zero, material_count),
      sphere_line_({.color = columns.color, .material = columns.material}, RangeOfW::above_zero,
                   material_count),
      marks_decimals_(marks_decimals) {
  const std::string names = " of a sphere (" + column_names(sphere_line_.attributes()) + ")";
  sphere_names_ = {"the center" + names, "the center + r i" + names, "the center + r j" + names,
                   "the center + r k" + names};
}

bool TriangleReader::read_buffered(TriangleBatch& batch) {
  static_assert(TextReader::kSlack >= kFixedTextSlack);
  constexpr int kShortPause = 8;
  if (pause_ > 0) {
    --pause_;
    return false;
  }
  if (batch.size() >= kBatchSize) return false;
  // Skips the blank line after a triangle that the general path has read.
  if (text_.buffered().starts_with('\n')) text_.skip(1, 1);
  std::array<DecimalMarks, 24> marks;
  const std::size_t old_size = batch.size();
  const std::size_t limit = std::min(kBatchSize - old_size, marks.size());
  const FixedTextPart part = vertex_line_.read_triangles(text_.buffered(), TriangleFrame::stage_text, limit,
                                                         marks, batch.triangles, batch.attributes);
  consume(part, batch);
  if (marks_decimals_ && !part.decimals)
    std::copy_n(marks.begin(), part.triangle_count, batch.decimal_marks.begin() + old_size);
  // A triangle that ends beyond the buffer is a miss, too, but only one.
  miss_count_ = part.triangle_count > 0 ? 0 : miss_count_ + 1;
  if (miss_count_ > 1) pause_ = kShortPause;
  return part.triangle_count > 0;
}

void TriangleReader::consume(const FixedTextPart& part, TriangleBatch& batch) {
  constexpr std::size_t kLinesPerTriangle = 4;
  const int decimals = part.decimals.value_or(0);
  const std::size_t old_size = batch.numbers.size();
  batch.complete(next_number_, text_.line_number() + 1);
  next_number_ += part.triangle_count;
  if (keeps_text_)
    batch.texts.add_fixed_form(text_.buffered().substr(0, part.length), min_fixed_triangle_length(decimals));
  text_.skip(part.length, part.triangle_count * kLinesPerTriangle);
  // With at most seven decimals and eight digits before the point, every coordinate is exactly its decimal.
  if (marks_decimals_) {
    batch.decimal_marks.resize(old_size);
    batch.decimal_marks.resize(batch.size(), decimals <= kExactDecimals ? kAllDecimal : std::uint16_t{0});
  }
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

void TriangleReader::read_sphere(LineScanner& line, TriangleBatch& batch) {
  line.word();
  line.expect_end("'sphere'");
  if (keeps_text_) batch.texts.add_line("sphere");
  Sphere sphere{.number = next_number_++};
  TriangleLines lines;  // of the center, and of each other point in turn
  const auto& [center, point, unused] = lines.vertices;
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    next_line_within("a sphere", text_, line, sphere_names_[i]);
    sphere.locations[i] = {line.line_number(), line.column()};
    if (keeps_text_) batch.texts.add_line(line.rest());
    LineScanner at_columns = line;
    sphere_line_.read(line, std::min<std::size_t>(i, 1), sphere_names_[i], lines);
    sphere.points[i] = i == 0 ? center.position : point.position;
    if (i == 0 || point.color == center.color) continue;
    for (int column = 0; column < 3; ++column) at_columns.word();
    at_columns.fail("the color of the sphere's center");
  }
  if (sphere_line_.attributes().color) sphere.color = center.color;
  sphere.material = lines.material;
  batch.spheres.push_back(sphere);
  if (keeps_text_) batch.texts.end_triangle();
}

InputError refused_sphere(const SourceLocation& location) {
  return {location, "triangles alone",
          "a sphere: trace draws it, and model --facets N makes triangles of it"};
}

void next_vertex_line(TextReader& text, LineScanner& line, std::size_t index) {
  next_line_within("a triangle", text, line, std::string(kVertexNames[index]));
}

void next_line_within(std::string_view object, TextReader& text, LineScanner& line,
                      const std::string& expected) {
  do {
    if (!text.next_line(line))
      throw InputError(text.end_location(), expected, "the end of the input inside " + std::string(object));
    if (line.at_end() && !line.is_comment())
      throw InputError(line.location(), expected, "a blank line inside " + std::string(object));
  } while (line.at_end());
  if (line.peek() == "error") throw earlier_failure(line);
}

}  // namespace pipeline
