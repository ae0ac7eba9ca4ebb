#pragma once

#include <cstdint>
#include <memory>

#include "libpipeline/stream/stage_text.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// Writes a stage text. A `bare` text, the course's form, has triangles alone.
class StageWriter {
 public:
  StageWriter(TextWriter& text, NumberFormat format, bool bare);

  void write_header(const StageHeader& header);
  void write(const TriangleBatch& batch);
  /// Ends the text, and flushes it.
  void finish();

 private:
  void write_sphere(const Sphere& sphere);
  void write_number(std::uint64_t number);
  std::size_t begin_run(const TriangleBatch& batch, std::size_t begin);
  void write_clipped(const ClipTriangle& unclipped, const AttributeArrays& attributes, std::size_t index);

  TextWriter& text_;
  NumberFormat format_;
  bool bare_;
  bool framed_ = false;
  AttributeSet columns_;
  std::uint64_t next_number_ = 0;
  std::shared_ptr<const ClipTriangle> last_unclipped_;
  AttributeArrays clipped_;  // of the clipped triangle being written
};

}  // namespace pipeline
