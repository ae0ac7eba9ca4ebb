// Writes a picture of one pixel to stdout, in the last of the formats that the library can write.

#include <array>

#include "libpipeline/picture/image_file.h"

int main() {
  const std::string name = "picture" + std::string(pipeline::image_extensions().back());
  const auto writer = pipeline::image_writer(1, name, 1, 1);
  writer->write_row(std::array{pipeline::Color{255, 128, 0}});
  writer->finish();
}
