#include "libpipeline/picture/image_formats.h"

namespace pipeline {

std::unique_ptr<ByteWriter> netpbm_writer(int descriptor, const std::string& path, PixelBytes pixels,
                                          int columns, int rows) {
  const bool is_color = pixels == PixelBytes::rgb8;
  const std::string size = std::to_string(columns) + " " + std::to_string(rows);
  return std::make_unique<PlainWriter<unsigned char>>(
      descriptor, path, (is_color ? "P6\n" : "P5\n") + size + (is_color ? "\n255\n" : "\n65535\n"));
}

}  // namespace pipeline
