// Replaces png_file.cpp where libpng was not found.
#include <cassert>

#include "libpipeline/picture/png_file.h"

namespace pipeline {

struct PngWriter::State {};

bool can_write_png() {
  return false;
}

PngWriter::PngWriter(int, const std::string&, PixelBytes, int, int) {
  assert(can_write_png());
}

PngWriter::~PngWriter() = default;
PngWriter::PngWriter(PngWriter&&) noexcept = default;

void PngWriter::write_row(std::span<const unsigned char>) {}

void PngWriter::finish() {}

}  // namespace pipeline
