#include "libpipeline/picture/depth_array.h"

#include <bit>
#include <cstring>
#include <limits>

#include "libpipeline/picture/image_file.h"

namespace pipeline {

static_assert(std::endian::native == std::endian::little);

void check_depth_array_name(const std::string& path) {
  if (extension_of(path) != ".npy" && !is_device_without_extension(path))
    reject_extension(path, "an array file", {".npy"});
}

DepthArrayWriter::DepthArrayWriter(int descriptor, const std::string& path, const Viewport& screen)
    : rear_(screen.rear), file_(descriptor, path) {
  std::string description = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                            std::to_string(screen.drawn_row_count()) + ", " + std::to_string(screen.columns) +
                            "), }";
  // The numbers begin at a multiple of 64, behind a line feed; ten bytes stand before the description.
  constexpr std::size_t kStart = 128;
  description.resize(kStart - 11, ' ');
  const char length = static_cast<char>(kStart - 10);
  file_.append(std::string("\x93NUMPY\x01\0", 8) + length + std::string(1, '\0') + description + "\n");
}

void DepthArrayWriter::write_row(std::span<const double> depths) {
  char* out = file_.reserve(depths.size_bytes());
  for (const double depth : depths) {
    const double number = depth < rear_ ? depth : std::numeric_limits<double>::quiet_NaN();
    std::memcpy(out, &number, sizeof number);
    out += sizeof number;
  }
  file_.commit(out);
}

}  // namespace pipeline
