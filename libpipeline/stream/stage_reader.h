#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "libpipeline/stream/deferred_error.h"
#include "libpipeline/stream/stage_text.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/stream/triangle_reader.h"
#include "libpipeline/stream/triangle_source.h"
#include "libpipeline/text/text_reader.h"

namespace pipeline {

/// Reads a stage text: the header on construction, then batch after batch. Errors are InputErrors.
class StageReader final : public TriangleSource {
 public:
  /// With `marks_decimals` batches say which coordinates are exact decimals, for exact coverage.
  explicit StageReader(TextReader& text, bool marks_decimals = false);

  [[nodiscard]] const StageHeader& header() const { return header_; }
  /// The place of the first word behind the header: where a header line that is missing should have stood
  /// before.
  [[nodiscard]] const SourceLocation& header_end() const { return header_end_; }
  /// From now on `clipped` triangles are read, which only projected texts have; before, they are mistakes.
  void accept_clipped() { accepts_clipped_ = true; }
  /// An InputError unless the text is framed: for who has to know that it is whole, even if nothing came of
  /// it.
  void expect_framed() const;
  /// False at the end of a text that ends as it should. How much of a text with a mistake passes does not
  /// depend on the size of blocks.
  bool read(TriangleBatch& batch) override;
  bool take_part(std::size_t size, TextPart& part, TriangleBatch& batch) override;
  [[nodiscard]] PartContents read_part(TextReader& part, TriangleBatch& batch) const override;
  void put_back(const TextPart& part) override { text_.put_back(part); }
  [[nodiscard]] StreamPosition location() const override;
  void pass(const StreamPosition& location) override;

 private:
  bool read_header_line(LineScanner& line);
  void fill(TriangleBatch& batch);
  void read_triangle(LineScanner& line, TriangleBatch& batch);
  void read_clipped(LineScanner& line);
  [[nodiscard]] bool is_end(const LineScanner& line) const;
  void read_end(LineScanner& line);
  void expect_unframed_end() const;
  [[noreturn]] void reject(LineScanner& line, const std::string& also_expected);

  TextReader& text_;
  bool marks_decimals_;
  StageHeader header_;
  SourceLocation header_end_;
  SourceLocation framed_location_;
  LineScanner line_;
  std::optional<TriangleReader> triangles_;  // behind the header
  bool line_is_pending_ = false;             // line_ was read but not yet used
  bool done_ = false;
  bool accepts_clipped_ = false;
  VertexLineReader clip_vertex_line_;
  std::shared_ptr<const ClipTriangle> whole_;  // what the next triangles with its number are pieces of
  std::uint64_t whole_number_ = 0;
  DeferredError deferred_error_;  // found behind triangles that were still to be given out
};

}  // namespace pipeline
