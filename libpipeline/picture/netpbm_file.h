#pragma once

#include <span>
#include <string>

namespace pipeline {

/// How the pixels of a row become bytes: red, green and blue; these and an alpha (PNG only); or 16 bits of
/// gray, the high byte first.
enum class PixelBytes { rgb8, rgba8, gray16 };

/// Takes a binary Netpbm image, a PPM (P6) or a PGM (P5), row by row from the top, and writes it in blocks.
/// Failures to write are IoErrors.
class NetpbmWriter {
 public:
  /// Writes to a file descriptor, which the caller keeps and closes; `path` names it in messages.
  NetpbmWriter(int descriptor, const std::string& path, PixelBytes pixels, int columns, int rows);

  /// Takes the bytes of the next row.
  void write_row(std::span<const unsigned char> bytes);
  /// Writes the rows still buffered; to be called after the last row.
  void finish();

 private:
  int descriptor_;
  std::string path_;
  std::string buffered_;
};

}  // namespace pipeline
