#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// An InputError unless the file's extension is .npy, in upper or lower case, or the file a device.
void check_array_name(const std::string& path);

/// Writes a number for each pixel of an image as an array of NumPy's format 1.0 (its page numpy.lib.format):
/// rows from the top. Failures to write are IoErrors.
template <typename Number>
class PixelArrayWriter {
 public:
  /// Writes to a file descriptor, which the caller keeps and closes; `path` names the file in messages.
  PixelArrayWriter(int descriptor, const std::string& path, const Viewport& screen);

  /// Takes the numbers of the next row, from the left.
  void write_row(std::span<const Number> numbers);
  /// Writes the rows still buffered; to be called after the last row.
  void finish() { file_.flush(); }

 private:
  TextWriter file_;
};

extern template class PixelArrayWriter<double>;
extern template class PixelArrayWriter<std::int64_t>;

}  // namespace pipeline
