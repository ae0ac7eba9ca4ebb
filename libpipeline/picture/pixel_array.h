#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// An InputError unless the file's extension is .npy, in upper or lower case, or the file a device.
void check_array_name(const std::string& path);

/// A writer of numbers, as an ImageWriter of colors: an array of NumPy's format 1.0 (its page
/// numpy.lib.format).
template <typename Number>
class PixelArrayWriter {
 public:
  PixelArrayWriter(int descriptor, const std::string& path, const Viewport& screen);
  void write_row(std::span<const Number> numbers);
  void finish() { file_.flush(); }

 private:
  TextWriter file_;
};

extern template class PixelArrayWriter<double>;
extern template class PixelArrayWriter<std::int64_t>;

}  // namespace pipeline
