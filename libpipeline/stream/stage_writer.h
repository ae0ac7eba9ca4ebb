#pragma once

#include <cstdint>
#include <memory>

#include "libpipeline/stream/stage_text.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

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
  void write_number(std::uint64_t number);
  void note_sizes(const TriangleBatch& batch);
  std::size_t write_fixed_form(const TriangleBatch& batch, std::size_t begin);
  void write_triangle(const TriangleBatch& batch, std::size_t index);
  void write_clipped(const ClipTriangle& unclipped);
  char* print_vertex(char* out, const Vec3& vertex, const Vec3& low_part);
  char* print_attributes(char* out, const AttributeArrays& attributes, std::size_t index, std::size_t vertex);

  TextWriter& text_;
  NumberFormat format_;
  bool bare_;
  bool framed_ = false;
  AttributeSet columns_;
  std::uint64_t next_number_ = 0;
  std::shared_ptr<const ClipTriangle> last_unclipped_;
  bool keeps_four_digits_ = false;
  bool has_filled_coordinate_ = false;
};

}  // namespace pipeline
