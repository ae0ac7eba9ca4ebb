#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/picture/depth_image.h"
#include "libpipeline/picture/pixel_array.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/output_file.h"
#include "libpipeline/text/text_writer.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// Writes the depths of all pixels, as text to standard output or a file, and, if they are requested, as an
/// image and an array; and the array of the triangles seen. `commit` moves the files to their names.
class PixelFiles {
 public:
  PixelFiles(TextWriter& standard_output, const ZbufOptions& chosen, const Viewport& screen);

  /// Takes the depths of the next row, from the top.
  void write_depths(std::span<const double> depths);
  [[nodiscard]] bool wants_triangles() const { return triangles_.has_value(); }
  /// Takes the numbers of the triangles of the next row, if they are wanted.
  void write_triangles(std::span<const std::int64_t> numbers) { triangles_->write_row(numbers); }
  /// Writes the rows still buffered and closes the files.
  void close();
  void commit();

 private:
  double rear_;
  std::optional<OutputFile> text_file_;
  std::optional<TextWriter> text_of_file_;
  TextWriter* text_ = nullptr;  // standard output or that of the file; null: none
  std::optional<OutputFile> image_file_;
  std::optional<DepthImageWriter> image_;
  std::optional<OutputFile> array_file_;
  std::optional<PixelArrayWriter<double>> array_;
  std::vector<double> array_row_;
  std::optional<OutputFile> triangles_file_;
  std::optional<PixelArrayWriter<std::int64_t>> triangles_;
};

}  // namespace pipeline
