#include "libpipeline/stage_reader.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

#include "libpipeline/fixed_text.h"
#include "libpipeline/number_parser.h"

namespace pipeline {
namespace {

// Nine numbers of one digit before the point and seven behind it, a separator each, and the blank line.
constexpr std::size_t kMinFixedTriangleLength = 9 * 10 + 1;
constexpr std::uint16_t kAllDecimal = 0x1ff;

bool is_vertex(std::string_view word) {
  return !word.empty() && (word.front() == '-' || word.front() == '+' || word.front() == '.' ||
                           (word.front() >= '0' && word.front() <= '9'));
}

bool is_header_keyword(std::string_view word) {
  constexpr std::array<std::string_view, 7> kKeywords = {"framed",      "eye",     "look", "up",
                                                         "perspective", "frustum", "ortho"};
  return std::find(kKeywords.begin(), kKeywords.end(), word) != kKeywords.end() ||
         is_appearance_keyword(word);
}

/// Which coordinates are exact decimals, as in a batch: with at most eight digits before the point those with
/// few behind it.
std::uint16_t decimal_marks(const PlainVertexLines& columns) {
  unsigned marks = 0;
  for (std::size_t i = 0; i < 9; ++i)
    if (columns[i / 3][i % 3].decimals <= kExactDecimals) marks |= 1u << i;
  return static_cast<std::uint16_t>(marks);
}

/// What is exact of a triangle's coordinates, as in a batch.
struct ExactParts {
  std::uint16_t marks = 0;
  Triangle low_parts{};

  /// Notes the vertex on `line`; words that are no numbers are left for others to find.
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

  /// Hands the notes to the batch's last triangle.
  void set_last(TriangleBatch& batch) const {
    batch.decimal_marks.resize(batch.size());
    batch.decimal_marks.back() = marks;
    if (low_parts == Triangle{} && batch.low_parts.empty()) return;
    batch.low_parts.resize(batch.size());
    batch.low_parts.back() = low_parts;
  }
};

}  // namespace

EarlierFailure::EarlierFailure(const Place& place, std::string reason)
    : InputError(place,
                 "an earlier stage failed" + (reason.empty() ? ", without saying why" : ": " + reason)),
      reason_(std::move(reason)) {}

StageReader::StageReader(TextReader& text, bool marks_decimals)
    : text_(text), marks_decimals_(marks_decimals) {
  while (!line_is_pending_ && text_.next_filled_line(line_)) {
    LineScanner line = line_;
    line_is_pending_ = !read_header_line(line);
  }
  check_camera(header_.camera);
  vertex_line_ = VertexLineReader(header_.appearance.columns());
  AttributeSet columns_in_clip_space = header_.appearance.columns();
  columns_in_clip_space.w = true;
  clip_vertex_line_ = VertexLineReader(columns_in_clip_space, RangeOfW::any);
  // A mistake here is told before anybody misses a header line that it hides.
  header_end_ = line_is_pending_ ? line_.place() : text_.end_place();
  if (!line_is_pending_) expect_unframed_end();
  const bool is_body =
      is_vertex(line_.peek()) || line_.peek() == "triangle" || line_.peek() == "clipped" || is_end(line_);
  if (line_is_pending_ && !is_body) reject(line_, "a header line, ");
}

/// Takes a header line; false if the line belongs to the body.
bool StageReader::read_header_line(LineScanner& line) {
  const Place place = line.place();
  const std::string_view keyword = line.word();
  if (is_appearance_keyword(keyword)) {
    read_appearance_part(keyword, place, line, AttributeSource::stage_text, header_.appearance);
    return true;
  }
  if (keyword != "framed") return read_camera_part(keyword, place, line, header_.camera);
  if (header_.framed)
    throw InputError(place,
                     expected_but_found("one 'framed'", "a second one after " + to_string(framed_place_)));
  line.expect_end("'framed'");
  header_.framed = true;
  framed_place_ = place;
  return true;
}

void StageReader::expect_framed() const {
  if (!header_.framed)
    throw InputError(header_end_,
                     expected_but_found("a framed text (model --framed)", "one without 'framed'"));
}

bool StageReader::read(TriangleBatch& batch) {
  batch.clear();
  if (mistake_) std::rethrow_exception(mistake_);
  try {
    fill(batch);
  } catch (const std::runtime_error&) {  // lack of memory may have left the batch half filled
    if (batch.empty()) throw;
    mistake_ = std::current_exception();
  }
  return !batch.empty();
}

void StageReader::fill(TriangleBatch& batch) {
  while (!done_) {
    // What is in memory is passed on before the reader waits for more: a triangle has three lines.
    if (!line_is_pending_ && !batch.empty() && (batch.size() >= kBatchSize || !text_.has_lines_waiting(3)))
      break;
    const bool may_be_plain = !line_is_pending_ && !whole_;
    if (may_be_plain && (read_fixed_form(batch) || read_plain_form(batch))) continue;
    if (!line_is_pending_ && !text_.next_filled_line(line_)) {
      expect_unframed_end();
      done_ = true;
      break;
    }
    line_is_pending_ = false;
    if (is_vertex(line_.peek())) {
      read_vertices(line_, batch);
    } else if (line_.peek() == "triangle") {
      line_.word();
      next_number_ = line_.count("the number of a triangle");
      line_.expect_end("the number of a triangle");
    } else if (accepts_clipped_ && line_.peek() == "clipped") {
      read_clipped(line_);
    } else if (is_end(line_)) {
      read_end(line_);
    } else {
      reject(line_, "");
    }
  }
}

/// Takes the triangles that are waiting as long as they have the form nearly all stage text has; false if the
/// next has another form, or is not there as a whole.
bool StageReader::read_fixed_form(TriangleBatch& batch) {
  static_assert(TextReader::kSlack >= kFixedTextSlack);
  if (vertex_line_.attributes().any()) return false;
  // The blank line behind a triangle that the general reader took.
  if (text_.waiting().starts_with('\n')) text_.skip(1, 1);
  const std::string_view waiting = text_.waiting();
  const std::size_t old_size = batch.size();
  const std::size_t most =
      std::min({kBatchSize - old_size, waiting.size() / kMinFixedTriangleLength, fixed_form_guess_});
  if (most == 0) return false;
  batch.triangles.resize(old_size + most);
  const FixedTextPart part = fixed_text_kernel().read(waiting, std::span(batch.triangles).subspan(old_size));
  batch.triangles.resize(old_size + part.triangle_count);
  constexpr std::size_t kLinesPerTriangle = 4;
  for (std::size_t i = 0; i < part.triangle_count; ++i) {
    const std::size_t line = text_.line_number() + i * kLinesPerTriangle;
    batch.lines.push_back({line + 1, line + 2, line + 3});
    batch.numbers.push_back(next_number_++);
  }
  text_.skip(part.length, part.triangle_count * kLinesPerTriangle);
  fixed_form_guess_ = part.triangle_count == most ? 2 * most : part.triangle_count + 1;
  if (!batch.low_parts.empty()) batch.low_parts.resize(batch.size());
  if (!batch.wholes.empty()) batch.wholes.resize(batch.size());
  // Seven decimals and at most eight digits before the point: every coordinate is its decimal.
  if (marks_decimals_) batch.decimal_marks.resize(batch.size(), kAllDecimal);
  return part.triangle_count > 0;
}

/// Takes some of the triangles that are waiting, as long as their lines hold plain numbers and nothing else;
/// false if the next does not. After a few the faster form is worth another try.
bool StageReader::read_plain_form(TriangleBatch& batch) {
  constexpr std::size_t kMostAtOnce = 32;
  const std::size_t limit = std::min(kBatchSize, batch.size() + kMostAtOnce);
  const std::size_t old_size = batch.size();
  while (batch.size() < limit && read_plain_triangle(batch)) {
  }
  return batch.size() > old_size;
}

bool StageReader::read_plain_triangle(TriangleBatch& batch) {
  static_assert(TextReader::kSlack >= kPlainNumberSlack);
  if (text_.waiting().starts_with('\n')) text_.skip(1, 1);
  const std::string_view waiting = text_.waiting();
  PlainVertexLines columns;
  const char* const end = vertex_line_.read_plain(waiting.data(), waiting.data() + waiting.size(), columns);
  if (end == nullptr) return false;
  std::array<VertexLine, 3> vertices;
  for (std::size_t i = 0; i < 3; ++i) vertices[i] = to_vertex_line(columns[i], vertex_line_.attributes());
  const std::size_t line = text_.line_number();
  batch.add({vertices[0].position, vertices[1].position, vertices[2].position}, next_number_++,
            {line + 1, line + 2, line + 3});
  batch.attributes.add(vertices, vertex_line_.attributes());
  if (marks_decimals_) {
    batch.decimal_marks.resize(batch.size());
    batch.decimal_marks.back() = decimal_marks(columns);
  }
  text_.skip(static_cast<std::size_t>(end - waiting.data()), 3);
  return true;
}

/// Moves on to the line of vertex `index` (from 0); only comments may stand before it.
void StageReader::next_vertex_line(LineScanner& line, std::size_t index) {
  const std::string expected(kVertexNames[index]);
  do {
    if (!text_.next_line(line))
      throw InputError(text_.end_place(),
                       expected_but_found(expected, "the end of the input inside a triangle"));
    if (line.at_end() && !line.is_comment())
      throw InputError(line.place(), expected_but_found(expected, "a blank line inside a triangle"));
  } while (line.at_end());
  if (line.peek() == "error") reject(line, "");
}

/// Reads the three lines of a triangle, of which `line` is the first.
void StageReader::read_vertices(LineScanner& line, TriangleBatch& batch) {
  Triangle triangle;
  VertexLines lines{};
  ExactParts exact;
  std::array<VertexLine, 3> vertices;
  const AttributeSet& attributes = vertex_line_.attributes();
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) next_vertex_line(line, i);
    if (marks_decimals_) exact.add_vertex(line, i);
    if (attributes.any()) {
      vertices[i] = vertex_line_.read(line, i);
      triangle[i] = vertices[i].position;
    } else {
      triangle[i] = line.vec3(kVertexNames[i]);
    }
    lines[i] = line.line_number();
  }
  if (whole_ && next_number_ != whole_number_) whole_.reset();
  batch.add(triangle, next_number_++, lines);
  batch.attributes.add(vertices, attributes);
  if (whole_) batch.set_last_whole(whole_);
  if (marks_decimals_) exact.set_last(batch);
}

/// Reads the line `clipped` and the three of a triangle in clip space.
void StageReader::read_clipped(LineScanner& line) {
  line.word();
  line.expect_end("'clipped'");
  ClipTriangle whole;
  for (std::size_t i = 0; i < 3; ++i) {
    next_vertex_line(line, i);
    whole[i] = clip_vertex_line_.read(line, i);
  }
  whole_ = std::make_shared<const ClipTriangle>(whole);
  whole_number_ = next_number_;
}

bool StageReader::is_end(const LineScanner& line) const {
  return header_.framed && line.peek() == "end";
}

/// Takes the last line of a framed text. Its newline is a part of it: a text that is cut there is cut.
void StageReader::read_end(LineScanner& line) {
  line.word();
  line.expect_end("'end'");
  if (!text_.last_line_was_ended())
    throw InputError(line.place(),
                     expected_but_found("the end of the line after 'end', which closes a framed text",
                                        "the end of the input"));
  if (text_.next_filled_line(line)) {
    if (line.peek() == "error") reject(line, "");
    line.fail("nothing after 'end'");
  }
  done_ = true;
}

void StageReader::expect_unframed_end() const {
  if (header_.framed)
    throw InputError(text_.end_place(),
                     expected_but_found("'end', which closes a framed text", "the end of the input"));
}

/// Says what is wrong with a line that has no place in a body. `also_expected` is what might have stood there
/// besides triangles.
void StageReader::reject(LineScanner& line, const std::string& also_expected) {
  const Place place = line.place();
  const LineScanner at_keyword = line;
  const std::string_view keyword = line.word();
  if (keyword == "error") throw EarlierFailure(place, std::string(line.rest_with_comment()));
  if (is_header_keyword(keyword))
    throw InputError(place, expected_but_found("header lines before the first triangle", quoted(keyword)));
  const std::string hint = keyword == "end" ? " ('end' needs a line 'framed' in the header)" : "";
  at_keyword.fail(also_expected + "'triangle N' or a vertex" + hint);
}

}  // namespace pipeline
