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

/// Reads the triangles and spheres of a stage text's body and counts them. A fast path reads nearly all
/// triangles, if they are completely buffered; the general path reads any triangle, line by line.
class TriangleReader {
 public:
  /// `columns` come from the header; materials have numbers below `material_count`. With `marks_decimals`,
  /// batches mark coordinates that are exact decimals.
  TriangleReader(TextReader& text, const AttributeSet& columns, std::size_t material_count,
                 bool marks_decimals);

  /// The number of the next triangle.
  [[nodiscard]] std::uint64_t next_number() const { return next_number_; }

  /// Makes later batches include the text of their triangles.
  void keep_text() { keeps_text_ = true; }
  /// Adds buffered triangles as long as the fast path reads them and the batch has fewer than kBatchSize;
  /// false if it cannot read the next one.
  bool read_buffered(TriangleBatch& batch);
  /// Takes the line `triangle N` before a triangle. An InputError at the word that is wrong.
  void read_number(LineScanner& line);
  /// Adds the triangle whose first line is `line`. An InputError at the word that is wrong.
  void read(LineScanner& line, TriangleBatch& batch);
  /// Adds the sphere whose first line, `sphere`, is `line`. An InputError at the word that is wrong.
  void read_sphere(LineScanner& line, TriangleBatch& batch);

 private:
  /// Consumes the next part of the text, triangles of four lines that the batch has only in `triangles` and
  /// `attributes`, and completes the batch.
  void consume(const FixedTextPart& part, TriangleBatch& batch);

  TextReader& text_;
  VertexLineReader vertex_line_;
  VertexLineReader sphere_line_;  // all columns but the normal
  std::array<std::string, 4> sphere_names_;
  bool marks_decimals_;
  bool keeps_text_ = false;
  std::uint64_t next_number_ = 0;
  int miss_count_ = 0;  // misses of the fast path in a row
  int pause_ = 0;       // triangles for the general path before the next try of the fast one
};

/// The error of a reader that does not accept spheres.
InputError refused_sphere(const SourceLocation& location);

/// Moves on to the line of vertex `index` (from 0) of a triangle; only comments may precede it. An InputError
/// if it is missing.
void next_vertex_line(TextReader& text, LineScanner& line, std::size_t index);
/// Moves on likewise to a line of an `object` ("a triangle"); `expected` names the line in messages.
void next_line_within(std::string_view object, TextReader& text, LineScanner& line,
                      const std::string& expected);

}  // namespace pipeline
