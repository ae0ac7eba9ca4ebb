#pragma once

#include <span>
#include <string>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// An InputError unless the file's extension is .npy, in upper or lower case, or the file a device.
void check_depth_array_name(const std::string& path);

/// Writes the depths (NDC z) of an image as an array of NumPy's format 1.0 (its page numpy.lib.format):
/// doubles, rows from the top, nan where nothing is seen. Failures to write are IoErrors.
class DepthArrayWriter {
 public:
  /// Writes to a file descriptor, which the caller keeps and closes; `path` names the file in messages.
  DepthArrayWriter(int descriptor, const std::string& path, const Viewport& screen);

  /// Takes the depths of the next row, from the left.
  void write_row(std::span<const double> depths);
  /// Writes the rows still buffered; to be called after the last row.
  void finish() { file_.flush(); }

 private:
  double rear_;
  TextWriter file_;
};

}  // namespace pipeline
