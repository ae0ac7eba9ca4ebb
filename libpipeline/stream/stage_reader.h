#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "libpipeline/stream/deferred_error.h"
#include "libpipeline/stream/stage_text.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/triangle_reader.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// Reads a stage text: the header on construction, then batch after batch. Errors are InputErrors.
class StageReader {
 public:
  /// With `marks_decimals`, batches mark coordinates that are exact decimals, for exact coverage.
  explicit StageReader(TextReader& text, bool marks_decimals = false);

  [[nodiscard]] const StageHeader& header() const { return header_; }
  /// The location of the first word after the header: a missing header line belongs before it.
  [[nodiscard]] const SourceLocation& header_end() const { return header_end_; }
  /// False if the text ends with its header.
  [[nodiscard]] bool has_body() const { return has_body_; }
  /// The count of decimals of the first number of the body; none if the body begins with a word.
  [[nodiscard]] std::optional<int> first_decimals() const { return first_decimals_; }
  /// The header's lines as written, without comments and surrounding blanks.
  [[nodiscard]] const std::string& header_text() const { return header_text_; }
  /// Makes later batches include the text of their triangles.
  void keep_text();
  /// Accepts `clipped` triangles from now on, which only projected texts have; without this they are errors.
  void accept_clipped() { accepts_clipped_ = true; }
  /// Accepts spheres from now on, which no projected text has; without this they are errors.
  void accept_spheres() { accepts_spheres_ = !header_.projected && !header_.appearance.columns().w; }
  /// An InputError unless the text is framed: only then is an empty text known to be complete.
  void expect_framed() const;
  /// Fills the batch with the next triangles: at least one, and as many as are buffered, up to kBatchSize.
  /// False, with an empty batch, at the proper end of the text. An error is thrown only after the triangles
  /// before it are delivered, for any block size.
  bool read(TriangleBatch& batch) {
    return deferred_error_.read(batch, [&] { fill(batch); });
  }

 private:
  bool read_header_line(LineScanner& line);
  bool read_camera_line(std::string_view keyword, const SourceLocation& location, LineScanner& line);
  void fill(TriangleBatch& batch);
  void read_triangle(LineScanner& line, TriangleBatch& batch);
  void expect_unclipped_material(const LineScanner& line, TriangleBatch& batch) const;
  void read_clipped(LineScanner& line);
  [[nodiscard]] bool is_end(const LineScanner& line) const { return header_.framed && line.peek() == "end"; }
  void read_end(LineScanner& line);
  void expect_unframed_end() const;
  [[noreturn]] void reject(LineScanner& line, const std::string& also_expected);

  TextReader& text_;
  StageHeader header_;
  std::string header_text_;
  SourceLocation header_end_;
  SourceLocation framed_location_;
  LineScanner line_;
  std::optional<TriangleReader> triangles_;  // made when the header is read
  bool line_is_pending_ = false;             // line_ is read but not yet used
  bool has_body_ = false;
  std::optional<int> first_decimals_;
  bool done_ = false;
  bool accepts_clipped_ = false;
  bool accepts_spheres_ = false;
  VertexLineReader clip_vertex_line_;
  std::shared_ptr<const ClipTriangle> unclipped_;  // the next triangles of its number are its pieces
  std::uint64_t unclipped_number_ = 0;
  std::uint32_t unclipped_material_ = 0;
  bool keeps_text_ = false;
  std::string clipped_text_;  // of unclipped_, until its first piece is read
  DeferredError deferred_error_;
};

}  // namespace pipeline
