#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "libpipeline/scene/vertex_attributes.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// Reads the triangles and spheres of a stage text's body and counts them. A fast path reads nearly all text,
/// as long as a triangle is completely buffered; the general path reads any triangle, line by line.
class TriangleReader {
 public:
  /// `columns` come from the header; numbers of materials have to be less than `material_count`. With
  /// `marks_decimals`, batches mark the coordinates that are exact decimals.
  TriangleReader(TextReader& text, const AttributeSet& columns, std::size_t material_count,
                 bool marks_decimals);

  /// The number of the next triangle.
  [[nodiscard]] std::uint64_t next_number() const { return next_number_; }

  /// From now on, batches get the text of their triangles, too.
  void keep_text() { keeps_text_ = true; }
  /// Adds some of the buffered triangles, as long as the fast path has them and the batch has fewer than
  /// kBatchSize; false if it does not have the next.
  bool read_buffered(TriangleBatch& batch);
  /// Takes the line `triangle N` before a triangle. An InputError at the word that is wrong.
  void read_number(LineScanner& line);
  /// Adds the triangle whose first line is `line`. An InputError at the word that is wrong.
  void read(LineScanner& line, TriangleBatch& batch);
  /// Adds the sphere whose first line, `sphere`, is `line`. An InputError at the word that is wrong.
  void read_sphere(LineScanner& line, TriangleBatch& batch);

 private:
  /// Consumes the part of the text that comes next, triangles of four lines which were added to the batch's
  /// `triangles` and attributes alone, and completes the batch.
  void consume(const FixedTextPart& part, TriangleBatch& batch);

  TextReader& text_;
  VertexLineReader vertex_line_;
  VertexLineReader sphere_line_;  // of all columns but the normal
  std::array<std::string, 4> sphere_names_;
  bool marks_decimals_;
  bool keeps_text_ = false;
  std::uint64_t next_number_ = 0;
  int miss_count_ = 0;  // of the fast path, in a row
  int pause_ = 0;       // triangles to read by the general path before trying the fast one
};

/// The error of a reader that has no use for a sphere.
InputError refused_sphere(const SourceLocation& location);

/// Moves on to the line of vertex `index` (from 0) of a triangle; only comments may stand before it. An
/// InputError if there is none.
void next_vertex_line(TextReader& text, LineScanner& line, std::size_t index);
/// The same for a line of an `object` ("a triangle"); `expected` names the line in messages.
void next_line_within(std::string_view object, TextReader& text, LineScanner& line,
                      const std::string& expected);

}  // namespace pipeline
