#pragma once

#include <memory>
#include <span>
#include <string>

#include "libpipeline/picture/netpbm_file.h"

namespace pipeline {

/// True if PNG files can be written: where the library was built with libpng.
bool can_write_png();

/// A writer of bytes as NetpbmWriter: a PNG image, row by row. Only where can_write_png().
class PngWriter {
 public:
  PngWriter(int descriptor, const std::string& path, PixelBytes pixels, int columns, int rows);
  ~PngWriter();
  PngWriter(PngWriter&&) noexcept;
  PngWriter& operator=(PngWriter&&) = delete;

  void write_row(std::span<const unsigned char> bytes);
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pipeline
