#pragma once

#include <span>
#include <string>

namespace pipeline {

/// How the pixels of a row become bytes: red, green and blue; these and an alpha (PNG only); or 16 bits of
/// gray, the high byte first.
enum class PixelBytes { rgb8, rgba8, gray16 };

/// A writer of bytes, as an ImageWriter of colors (image_file.h): a binary Netpbm image, a PPM (P6) or a PGM
/// (P5), in blocks.
class NetpbmWriter {
 public:
  NetpbmWriter(int descriptor, const std::string& path, PixelBytes pixels, int columns, int rows);
  void write_row(std::span<const unsigned char> bytes);
  void finish();

 private:
  int descriptor_;
  std::string path_;
  std::string buffered_;
};

}  // namespace pipeline
