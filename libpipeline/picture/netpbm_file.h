#pragma once

#include <span>
#include <string>

#include "libpipeline/picture/pixel_bytes.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

/// Takes a binary Netpbm image, a PPM (P6) or a PGM (P5), row by row from the top. Failures to write are
/// IoErrors.
class NetpbmWriter {
 public:
  /// Writes to a file descriptor, which stays the caller's; `path` names it in messages.
  NetpbmWriter(int descriptor, const std::string& path, PixelBytes pixels, int columns, int rows)
      : file_(descriptor, path) {
    const bool is_color = pixels == PixelBytes::rgb8;
    file_.append((is_color ? "P6\n" : "P5\n") + std::to_string(columns) + " " + std::to_string(rows) +
                 (is_color ? "\n255\n" : "\n65535\n"));
  }

  /// Takes the bytes of the next row.
  void write_row(std::span<const unsigned char> bytes) {
    file_.append({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  /// Writes the rows still buffered; to be called after the last row.
  void finish() { file_.flush(); }

 private:
  TextWriter file_;
};

}  // namespace pipeline
