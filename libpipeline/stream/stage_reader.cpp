#include "libpipeline/stream/stage_reader.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "libpipeline/scene/header_line.h"
#include "libpipeline/scene/scene_commands.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/number_parser.h"

namespace pipeline {
namespace {

// Header keywords other than the settings of the appearance.
constexpr std::array<std::string_view, 9> kKeywords = {
    "framed", "eye", "look", "up", "perspective", "frustum", "ortho", "projected", "bounds"};

bool is_header_keyword(std::string_view word) {
  return std::find(kKeywords.begin(), kKeywords.end(), word) != kKeywords.end() || is_setting(word);
}

std::string keyword_hint(std::string_view word) {
  std::vector<std::string_view> known(kKeywords.begin(), kKeywords.end());
  const auto settings = scene_words(&SceneCommand::is_setting);
  known.insert(known.end(), settings.begin(), settings.end());
  known.insert(known.end(), {"triangle", "sphere", "clipped"});
  return spelling_hint(word, known);
}

Bounds read_bounds(LineScanner& line) {
  const auto number = [&](std::string_view name) {
    return number_where(line, name, "of at least 0", [](double value) { return value >= 0; });
  };
  const auto space = std::ranges::find(Bounds::kSpaces, line.peek());
  if (space == Bounds::kSpaces.end()) line.fail("the space 'world', 'view' or 'ndc'");
  line.word();
  Bounds bounds;
  bounds.space = *space;
  bounds.error = {number("the absolute bound"), number("the relative bound")};
  if (bounds.space == "ndc")
    bounds.rounded = {number("the absolute rounding"), number("the relative rounding")};
  line.expect_end("the bounds");
  return bounds;
}

}  // namespace

StageReader::StageReader(TextReader& text, bool marks_decimals) : text_(text) {
  while (!line_is_pending_ && text_.next_filled_line(line_)) {
    LineScanner line = line_;
    line_is_pending_ = !read_header_line(line);
    if (!line_is_pending_) (header_text_ += line_.rest()) += '\n';
  }
  has_body_ = line_is_pending_;
  if (const std::string_view first = line_.peek(); begins_like_number(first))
    first_decimals_ = static_cast<int>(first.substr(std::min(first.find('.'), first.size() - 1) + 1).size());
  check_camera(header_.camera);
  const std::size_t material_count = std::max<std::size_t>(header_.appearance.materials.size(), 1);
  triangles_.emplace(text_, header_.appearance.columns(), material_count, marks_decimals);
  AttributeSet columns_in_clip_space = header_.appearance.columns();
  columns_in_clip_space.w = true;
  clip_vertex_line_ = VertexLineReader(columns_in_clip_space, RangeOfW::any, material_count);
  // An error here may hide a header line, so it is reported before a caller reports that line as missing.
  header_end_ = line_is_pending_ ? line_.location() : text_.end_location();
  if (!line_is_pending_) expect_unframed_end();
  const bool is_body = begins_like_number(line_.peek()) || line_.peek() == "triangle" ||
                       line_.peek() == "sphere" || line_.peek() == "clipped" || is_end(line_);
  if (line_is_pending_ && !is_body) reject(line_, "a header line, ");
}

/// Takes a header line; false if the line belongs to the body.
// T1, T14
bool StageReader::read_header_line(LineScanner& line) {
  const SourceLocation location = line.location();
  const std::string_view keyword = line.word();
  if (is_setting(keyword)) {
    read_appearance_part(keyword, location, line, AttributeSource::stage_text, header_.appearance);
    return true;
  }
  if (keyword == "bounds") {
    if (header_.bounds) throw given_twice("'bounds'", header_.bounds->location, location);
    header_.bounds = {read_bounds(line), location};
    return true;
  }
  if (keyword != "framed") {
    const bool is_of_camera = read_camera_line(keyword, location, line);
    if (is_of_camera) header_.camera_lines.push_back({std::string(keyword), location});
    return is_of_camera;
  }
  if (header_.framed) throw given_twice("'framed'", framed_location_, location);
  line.expect_end("'framed'");
  header_.framed = true;
  framed_location_ = location;
  return true;
}

/// Takes the rest of a line about the camera, after `keyword`; false for another line.
bool StageReader::read_camera_line(std::string_view keyword, const SourceLocation& location,
                                   LineScanner& line) {
  if (keyword != "projected") return read_camera_part(keyword, location, line, header_.camera);
  if (header_.projected) throw given_twice("'projected'", header_.projected->location, location);
  const std::string_view volume = line.peek();
  if (volume != "frustum" && volume != "ortho") line.fail("frustum or ortho");
  line.word();
  const SourceLocation planes = line.location();
  header_.projected = {read_projection(volume, line), planes};
  return true;
}

void StageReader::keep_text() {
  keeps_text_ = true;
  triangles_->keep_text();
}

void StageReader::expect_framed() const {
  if (!header_.framed)
    throw InputError(header_end_, "a framed text (model --framed)",
                     text_.bytes_read() == 0 ? "an empty one" : "one without 'framed'");
}

void StageReader::fill(TriangleBatch& batch) {
  while (!done_) {
    // Triangles are passed on before the reader waits for more text; a triangle has three lines.
    if (!line_is_pending_ && !batch.empty() &&
        (batch.object_count() >= kBatchSize || !text_.has_buffered_lines(3)))
      break;
    const bool may_be_decimal = !line_is_pending_ && !unclipped_ && batch.spheres.empty();
    if (may_be_decimal && triangles_->read_buffered(batch)) continue;
    if (!line_is_pending_ && !text_.next_filled_line(line_)) {
      expect_unframed_end();
      done_ = true;
      break;
    }
    const bool is_triangle = begins_like_number(line_.peek());
    const bool is_sphere = !is_triangle && accepts_spheres_ && line_.peek() == "sphere";
    // A triangle after a sphere belongs to the next batch; only an empty batch waits for a sphere's lines.
    line_is_pending_ = (is_triangle && !batch.spheres.empty()) ||
                       (is_sphere && !batch.empty() && !text_.has_buffered_lines(4));
    if (line_is_pending_) break;
    if (is_triangle) {
      read_triangle(line_, batch);
    } else if (line_.peek() == "triangle") {
      triangles_->read_number(line_);
    } else if (accepts_clipped_ && line_.peek() == "clipped") {
      read_clipped(line_);
    } else if (is_sphere) {
      triangles_->read_sphere(line_, batch);
    } else if (is_end(line_)) {
      read_end(line_);
    } else {
      reject(line_, "");
    }
  }
}

/// Reads the triangle whose first line is `line`.
void StageReader::read_triangle(LineScanner& line, TriangleBatch& batch) {
  if (unclipped_ && triangles_->next_number() != unclipped_number_) unclipped_.reset();
  if (unclipped_) batch.texts.add(clipped_text_);
  clipped_text_.clear();
  const LineScanner at_vertex = line;
  triangles_->read(line, batch);
  if (unclipped_ && header_.appearance.columns().material) expect_unclipped_material(at_vertex, batch);
  if (unclipped_) batch.set_last_unclipped(unclipped_);
}

/// Throws an InputError, at the given vertex line, if the last triangle has another material than the
/// triangle it is a piece of. The batch then ends before it.
void StageReader::expect_unclipped_material(const LineScanner& line, TriangleBatch& batch) const {
  const std::uint32_t material = batch.attributes.materials.back();
  if (material == unclipped_material_) return;
  batch.truncate(batch.size() - 1);
  LineScanner at_material = line;  // the last column
  for (LineScanner rest = line; !rest.at_end(); rest.word()) at_material = rest;
  at_material.fail("the material of the triangle that was clipped, " + std::to_string(unclipped_material_));
}

/// Reads the line `clipped` and the three vertex lines of a triangle in clip space.
// T11
void StageReader::read_clipped(LineScanner& line) {
  line.word();
  line.expect_end("'clipped'");
  TriangleLines unclipped;
  clipped_text_ = keeps_text_ ? "clipped\n" : "";
  for (std::size_t i = 0; i < 3; ++i) {
    next_vertex_line(text_, line, i);
    if (keeps_text_) (clipped_text_ += line.rest()) += '\n';
    clip_vertex_line_.read(line, i, unclipped);
  }
  if (keeps_text_) clipped_text_ += '\n';
  unclipped_ = std::make_shared<const ClipTriangle>(unclipped.vertices);
  unclipped_material_ = unclipped.material;
  unclipped_number_ = triangles_->next_number();
}

/// Takes the last line of a framed text, newline included: a text without it has been truncated.
// T13
void StageReader::read_end(LineScanner& line) {
  line.word();
  line.expect_end("'end'");
  if (!text_.last_line_was_ended())
    throw InputError(line.location(), "the end of the line after 'end', which closes a framed text",
                     "the end of the input");
  if (text_.next_filled_line(line)) {
    if (line.peek() == "error") reject(line, "");
    line.fail("nothing after 'end'");
  }
  done_ = true;
}

void StageReader::expect_unframed_end() const {
  if (header_.framed)
    throw InputError(text_.end_location(), "'end', which closes a framed text", "the end of the input");
}

/// Throws the error of a line that does not belong in a body. `also_expected` names lines allowed there
/// besides.
void StageReader::reject(LineScanner& line, const std::string& also_expected) {
  const SourceLocation location = line.location();
  const LineScanner at_keyword = line;
  if (line.peek() == "error") throw earlier_failure(line);
  const std::string_view keyword = line.word();
  if (keyword == "sphere") throw refused_sphere(location);
  if (is_header_keyword(keyword))
    throw InputError(location, "header lines before the first triangle", quoted(keyword));
  const std::string hint = keyword == "end" ? " ('end' needs a line 'framed' in the header)" : "";
  at_keyword.fail(also_expected + "'triangle N' or a vertex" + hint, keyword_hint(keyword));
}

}  // namespace pipeline
