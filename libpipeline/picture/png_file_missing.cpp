// Replaces png_file.cpp where libpng was not found.
#include "libpipeline/picture/image_formats.h"

namespace pipeline {

bool can_write_png() {
  return false;
}

std::unique_ptr<ByteWriter> png_writer(int, const std::string&, PixelBytes, int, int) {
  return nullptr;
}

}  // namespace pipeline
