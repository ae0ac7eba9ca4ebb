#pragma once

#include <optional>
#include <span>
#include <string>

#include "libpipeline/picture/depth_array.h"
#include "libpipeline/picture/depth_image.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/output_file.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// Writes the depths of all pixels: as text to standard output or a file, and as an image and an
/// array if they are requested. `commit` moves the files to their names.
class DepthFiles {
 public:
  /// `text_path` is "-" for `standard_output`, "none" for no text; an empty path of the others means no file.
  DepthFiles(TextWriter& standard_output, const std::string& text_path, const std::string& image_path,
             const std::string& array_path, const Viewport& screen);

  /// Takes the depths of the next row, from the top.
  void write_row(std::span<const double> depths);
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
  std::optional<DepthArrayWriter> array_;
};

}  // namespace pipeline
