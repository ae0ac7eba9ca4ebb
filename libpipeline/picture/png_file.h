#pragma once

#include <memory>
#include <span>
#include <string>

#include "libpipeline/picture/netpbm_file.h"

namespace pipeline {

/// True if PNG files can be written: where the library was built with libpng.
bool can_write_png();

/// Takes a PNG image row by row, from the top, and writes the rows as they come. Failures to write are
/// IoErrors.
class PngWriter {
 public:
  /// Writes to a file descriptor, which the caller keeps and closes; `path` names it in messages. Only where
  /// can_write_png().
  PngWriter(int descriptor, const std::string& path, PixelBytes pixels, int columns, int rows);
  ~PngWriter();
  PngWriter(PngWriter&&) noexcept;
  PngWriter& operator=(PngWriter&&) = delete;

  /// Takes the bytes of the next row.
  void write_row(std::span<const unsigned char> bytes);
  /// Ends the file; to be called after the last row.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pipeline
