#pragma once

#include <cstdint>
#include <exception>
#include <string>

#include "libpipeline/appearance.h"
#include "libpipeline/camera.h"
#include "libpipeline/number_text.h"
#include "libpipeline/text_reader.h"
#include "libpipeline/text_writer.h"
#include "libpipeline/triangle_batch.h"

namespace pipeline {

// Stage text, what flows in the pipes between the tools:
//
//   header lines   a keyword and its numbers, each at most once, before the first triangle:
//                    framed | eye X Y Z | look X Y Z | up X Y Z |
//                    perspective FOVY ASPECT NEAR FAR | frustum L R B T N F | ortho L R B T N F |
//                    attributes [w] [color] [normal] | background R G B | ambient R G B |
//                    material AMBIENT DIFFUSE SPECULAR SHININESS |
//                    attenuation CONSTANT LINEAR QUADRATIC | light X Y Z R G B (any number)
//   triangle N     optional: the next triangle is triangle N of the scene; counting goes on from there
//   X Y Z          three vertex lines, then a blank line; behind the position the columns that `attributes`
//                  names, in this order: W, R G B (0 to 255), NX NY NZ
//   error ...      an earlier stage failed, and what it said; nothing follows
//   end            the last line of a framed text
//
// Comments (from # to the end of the line) and blank lines may stand anywhere, but no blank line inside a
// triangle.

/// The header of a stage text: what later stages still need.
struct StageHeader {
  bool framed = false;
  CameraText camera;
  Appearance appearance = {};
};

/// The text ends with an `error` line. `reason()` is what stands on it: "tool: message" of the stage that
/// failed.
class EarlierFailure : public InputError {
 public:
  EarlierFailure(const Place& place, std::string reason);
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

/// Reads a stage text: the header on construction, then batch after batch. Errors are InputErrors.
class StageReader {
 public:
  /// With `marks_decimals` batches say which coordinates are exact decimals, for exact coverage.
  explicit StageReader(TextReader& text, bool marks_decimals = false);

  [[nodiscard]] const StageHeader& header() const { return header_; }
  /// The place of the first word behind the header: where a header line that is missing should have stood
  /// before.
  [[nodiscard]] const Place& header_end() const { return header_end_; }
  /// Fills `batch` with the next triangles, as many as are waiting but at least one; false (and an empty
  /// batch) at the end of a text that ends as it should. Triangles before a mistake are given out before the
  /// mistake is thrown, so that it does not depend on the size of blocks how much of the text passes.
  bool read(TriangleBatch& batch);

 private:
  bool read_header_line(LineScanner& line);
  void fill(TriangleBatch& batch);
  bool read_fixed_form(TriangleBatch& batch);
  void next_vertex_line(LineScanner& line, std::size_t index);
  void read_vertices(LineScanner& line, TriangleBatch& batch);
  [[nodiscard]] bool is_end(const LineScanner& line) const;
  void read_end(LineScanner& line);
  void expect_unframed_end() const;
  [[noreturn]] void reject(LineScanner& line, const std::string& also_expected);

  TextReader& text_;
  bool marks_decimals_;
  StageHeader header_;
  Place header_end_;
  Place framed_place_;
  LineScanner line_;
  VertexLineReader vertex_line_;
  std::size_t fixed_form_guess_ = 1;  // how many triangles in fixed form to expect: room is made for them
  bool line_is_pending_ = false;      // line_ was read but not yet used
  bool done_ = false;
  std::uint64_t next_number_ = 0;
  std::exception_ptr mistake_;  // found behind triangles that were still to be given out
};

/// Writes a stage text. `bare` leaves out everything but the triangles: the course's form.
class StageWriter {
 public:
  StageWriter(TextWriter& text, NumberFormat format, bool bare);

  void write_header(const StageHeader& header);
  void write(const TriangleBatch& batch);
  /// Writes what a whole text ends with, and flushes.
  void finish();

  /// True unless all coordinates written so far, some of them not 0, are so small that their decimals hold
  /// fewer than four significant digits.
  [[nodiscard]] bool keeps_four_digits() const { return keeps_four_digits_ || !has_filled_coordinate_; }

 private:
  void note_sizes(const TriangleBatch& batch);
  std::size_t write_fixed_form(const TriangleBatch& batch, std::size_t begin);
  void write_triangle(const TriangleBatch& batch, std::size_t index);
  char* print_vertex(char* out, const Vec3& vertex, const Vec3& low_part);
  char* print_attributes(char* out, const AttributeArrays& attributes, std::size_t index, std::size_t vertex);

  TextWriter& text_;
  NumberFormat format_;
  bool bare_;
  bool framed_ = false;
  AttributeSet columns_;
  std::uint64_t next_number_ = 0;
  bool keeps_four_digits_ = false;
  bool has_filled_coordinate_ = false;
};

/// The line a failed stage ends its output with: "error tool: message".
std::string error_line(const std::string& reason);

}  // namespace pipeline
