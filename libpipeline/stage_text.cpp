#include "libpipeline/stage_text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <span>

#include "libpipeline/fixed_text.h"

namespace pipeline {
namespace {

// Position, w, colour and normal.
constexpr std::size_t kMaxVertexLength = 10 * (kMaxNumberLength + 1);
// Nine numbers of one digit before the point and seven behind it, a separator each, and the blank line.
constexpr std::size_t kMinFixedTriangleLength = 9 * 10 + 1;
constexpr std::uint16_t kAllDecimal = 0x1ff;
// "triangle N", three vertex lines and the blank line.
constexpr std::size_t kMaxTriangleLength = 40 + 3 * kMaxVertexLength + 1;

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

void print_numbers(TextWriter& text, std::string_view keyword, std::initializer_list<double> numbers) {
  text.append(keyword);
  for (const double number : numbers) {
    char* out = text.reserve(kMaxNumberLength + 1);
    *out++ = ' ';
    text.commit(print_number(out, number, 0, {.shortest = true}));
  }
}

void print_header_numbers(TextWriter& text, std::string_view keyword, std::initializer_list<double> numbers) {
  print_numbers(text, keyword, numbers);
  text.append("\n");
}

void print_projection(TextWriter& text, const Projection& projection) {
  if (const auto* p = std::get_if<Perspective>(&projection)) {
    print_header_numbers(text, "perspective", {p->fov_y_degrees, p->aspect, p->near, p->far});
  } else if (const auto* f = std::get_if<Frustum>(&projection)) {
    print_header_numbers(text, "frustum", {f->left, f->right, f->bottom, f->top, f->near, f->far});
  } else {
    const auto& o = std::get<Orthographic>(projection);
    print_header_numbers(text, "ortho", {o.left, o.right, o.bottom, o.top, o.near, o.far});
  }
}

void print_attribute_names(TextWriter& text, const AttributeSet& attributes) {
  text.append("attributes");
  if (attributes.w) text.append(" w");
  if (attributes.color) text.append(" color");
  if (attributes.normal) text.append(" normal");
  text.append("\n");
}

void print_appearance(TextWriter& text, const Appearance& look) {
  const auto print_vec3 = [&](std::string_view keyword, const std::optional<Placed<Vec3>>& v) {
    if (v) print_header_numbers(text, keyword, {v->value.x, v->value.y, v->value.z});
  };
  if (look.attributes) print_attribute_names(text, look.attributes->value);
  print_vec3("background", look.background);
  print_vec3("ambient", look.ambient);
  if (look.material) {
    const Material& m = look.material->value;
    print_numbers(text, "material", {m.ambient, m.diffuse, m.specular});
    text.append(" " + std::to_string(m.shininess) + "\n");
  }
  if (look.attenuation) {
    const Attenuation& a = look.attenuation->value;
    print_header_numbers(text, "attenuation", {a.constant, a.linear, a.quadratic});
  }
  for (const auto& [light, place] : look.lights) {
    const auto& [p, i] = light;
    print_header_numbers(text, "light", {p.x, p.y, p.z, i.x, i.y, i.z});
  }
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

std::string error_line(const std::string& reason) {
  return "error " + on_one_line(reason) + "\n";
}

StageReader::StageReader(TextReader& text, bool marks_decimals)
    : text_(text), marks_decimals_(marks_decimals) {
  while (!line_is_pending_ && text_.next_filled_line(line_)) {
    LineScanner line = line_;
    line_is_pending_ = !read_header_line(line);
  }
  check_camera(header_.camera);
  vertex_line_ = VertexLineReader(header_.appearance.columns());
  // A mistake here is told before anybody misses a header line that it hides.
  header_end_ = line_is_pending_ ? line_.place() : text_.end_place();
  if (!line_is_pending_) expect_unframed_end();
  const bool is_body = is_vertex(line_.peek()) || line_.peek() == "triangle" || is_end(line_);
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

bool StageReader::read(TriangleBatch& batch) {
  batch.clear();
  if (mistake_) std::rethrow_exception(mistake_);
  try {
    fill(batch);
  } catch (...) {
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
    if (!line_is_pending_ && !vertex_line_.attributes().any() && read_fixed_form(batch)) continue;
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
  // Seven decimals and at most eight digits before the point: every coordinate is its decimal.
  if (marks_decimals_) batch.decimal_marks.resize(batch.size(), kAllDecimal);
  return part.triangle_count > 0;
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
  batch.add(triangle, next_number_++, lines);
  batch.attributes.add(vertices, attributes);
  if (marks_decimals_) exact.set_last(batch);
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

StageWriter::StageWriter(TextWriter& text, NumberFormat format, bool bare)
    : text_(text), format_(format), bare_(bare) {}

void StageWriter::write_header(const StageHeader& header) {
  if (bare_) return;
  framed_ = header.framed;
  if (framed_) text_.append("framed\n");
  const CameraText& camera = header.camera;
  const auto print_vec3 = [&](std::string_view keyword, const std::optional<Placed<Vec3>>& v) {
    if (v) print_header_numbers(text_, keyword, {v->value.x, v->value.y, v->value.z});
  };
  print_vec3("eye", camera.eye);
  print_vec3("look", camera.look);
  print_vec3("up", camera.up);
  if (camera.projection) print_projection(text_, camera.projection->value);
  print_appearance(text_, header.appearance);
  columns_ = header.appearance.columns();
}

void StageWriter::write(const TriangleBatch& batch) {
  assert(batch.low_parts.empty() || batch.low_parts.size() == batch.size());
  if (!keeps_four_digits_) note_sizes(batch);
  const bool may_be_fixed =
      format_.decimals == 7 && !format_.shortest && batch.low_parts.empty() && !columns_.any();
  std::size_t index = 0;
  while (index < batch.size()) {
    if (may_be_fixed) index += write_fixed_form(batch, index);
    if (index < batch.size()) write_triangle(batch, index++);
  }
}

/// A coordinate of which the text keeps four digits settles the question; until then every one is looked at.
void StageWriter::note_sizes(const TriangleBatch& batch) {
  double smallest_with_four_digits = 1000;
  for (int i = 0; i < format_.decimals; ++i) smallest_with_four_digits /= 10;
  for (const Triangle& triangle : batch.triangles) {
    for (const Vec3& vertex : triangle) {
      for (const double coordinate : {vertex.x, vertex.y, vertex.z}) {
        has_filled_coordinate_ |= coordinate != 0;
        keeps_four_digits_ |= format_.shortest || std::fabs(coordinate) >= smallest_with_four_digits;
      }
    }
    if (keeps_four_digits_) return;
  }
}

/// Prints triangles from `begin` on as long as counting goes right and they fit the form nearly all stage
/// text has; says how many.
std::size_t StageWriter::write_fixed_form(const TriangleBatch& batch, std::size_t begin) {
  constexpr std::size_t kMostAtOnce = 256;
  const std::size_t limit = std::min(batch.size(), begin + kMostAtOnce);
  std::size_t end = begin;
  while (end < limit && (bare_ || batch.numbers[end] == next_number_ + (end - begin))) ++end;
  if (end == begin) return 0;
  char* const out = text_.reserve((end - begin) * kMaxFixedTriangleLength + kFixedTextSlack);
  const auto triangles = std::span(batch.triangles).subspan(begin, end - begin);
  const FixedTextPart part = fixed_text_kernel().write(triangles, out);
  text_.commit(out + part.length);
  if (part.triangle_count > 0) next_number_ = batch.numbers[begin + part.triangle_count - 1] + 1;
  return part.triangle_count;
}

void StageWriter::write_triangle(const TriangleBatch& batch, std::size_t index) {
  if (batch.numbers[index] != next_number_ && !bare_)
    text_.append("triangle " + std::to_string(batch.numbers[index]) + "\n");
  next_number_ = batch.numbers[index] + 1;
  const Triangle low_part = batch.low_parts.empty() ? Triangle{} : batch.low_parts[index];
  char* out = text_.reserve(kMaxTriangleLength);
  for (std::size_t v = 0; v < 3; ++v) {
    out = print_vertex(out, batch.triangles[index][v], low_part[v]);
    if (columns_.any()) out = print_attributes(out, batch.attributes, index, v);
    *out++ = '\n';
  }
  *out++ = '\n';
  text_.commit(out);
}

/// Prints three numbers, blanks between.
char* StageWriter::print_vertex(char* out, const Vec3& vertex, const Vec3& low_part) {
  out = print_number(out, vertex.x, low_part.x, format_);
  *out++ = ' ';
  out = print_number(out, vertex.y, low_part.y, format_);
  *out++ = ' ';
  return print_number(out, vertex.z, low_part.z, format_);
}

char* StageWriter::print_attributes(char* out, const AttributeArrays& attributes, std::size_t index,
                                    std::size_t vertex) {
  const auto print_vec3 = [&](const Vec3& v) {
    *out++ = ' ';
    out = print_vertex(out, v, {});
  };
  if (columns_.w) {
    *out++ = ' ';
    out = print_number(out, attributes.w[index][vertex], 0, {.shortest = true});
  }
  if (columns_.color) print_vec3(attributes.colors[index][vertex]);
  if (columns_.normal) print_vec3(attributes.normals[index][vertex]);
  return out;
}

void StageWriter::finish() {
  if (framed_) text_.append("end\n");
  text_.flush();
}

}  // namespace pipeline
