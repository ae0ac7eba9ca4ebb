#include "libpipeline/picture/netpbm_file.h"

#include <cstddef>

#include "libpipeline/text/text_writer.h"

namespace pipeline {
namespace {

constexpr std::size_t kBufferSize = std::size_t{1} << 16;

}  // namespace

NetpbmWriter::NetpbmWriter(int descriptor, const std::string& path, PixelBytes pixels, int columns, int rows)
    : descriptor_(descriptor), path_(path) {
  const bool is_color = pixels == PixelBytes::rgb8;
  buffered_ = (is_color ? "P6\n" : "P5\n") + std::to_string(columns) + " " + std::to_string(rows) +
              (is_color ? "\n255\n" : "\n65535\n");
}

void NetpbmWriter::write_row(std::span<const unsigned char> bytes) {
  buffered_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (buffered_.size() >= kBufferSize) finish();
}

void NetpbmWriter::finish() {
  write_all(descriptor_, buffered_, path_);
  buffered_.clear();
}

}  // namespace pipeline
