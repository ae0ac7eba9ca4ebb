#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/picture/png_file.h"
#include "libpipeline/scene/color.h"

namespace pipeline {

enum class ImageFormat {
  bmp,  // Windows bitmap, 24 bits a pixel, rows from the bottom; at most 4 GiB
  ppm,  // Netpbm P6, 8 bits a channel, rows from the top
  png,  // 8 bits a channel; only where can_write_png()
};

/// The format a file's extension stands for, upper or lower case. A device's name (/dev/null, /dev/stdout)
/// has none: it gets PPM, which can be written from start to end. Any other name is an InputError, and so is
/// .png where there is no libpng.
ImageFormat image_format_of(const std::string& path);

/// The extension of a file's name in lower case: ".bmp".
std::string extension_of(const std::string& path);
/// True for names like /dev/null, where no extension says a format.
bool is_device_without_extension(const std::string& path);
/// Throws the InputError that says which extensions `kind` ("an image file") may have: `formats` and, where
/// there is libpng, .png.
[[noreturn]] void reject_extension(const std::string& path, const std::string& kind,
                                   const std::string& formats);

/// An InputError naming `path` if the format cannot hold an image of that size: BMP counts its bytes in 32
/// bits.
void check_image_size(ImageFormat format, int columns, int rows, const std::string& path);

/// Takes an image row by row, from the top, and writes it in blocks of 4 MiB, so that only few rows are in
/// memory; but a BMP that goes where there is no seeking (a pipe) is held as a whole. Failures to write are
/// IoErrors.
class ImageWriter {
 public:
  /// Writes to a file descriptor, which stays the caller's; `path` names it in messages.
  /// Throws like check_image_size.
  ImageWriter(int descriptor, const std::string& path, ImageFormat format, int columns, int rows);

  /// Takes the next row, `columns` pixels from the left.
  void write_row(std::span<const Color> colors);
  /// Writes what is not written yet; to be called after the last row.
  void finish();

 private:
  void write_bmp_header();
  char* place_for_next_row();
  void write_rows();

  int descriptor_;
  std::string path_;
  ImageFormat format_;
  int columns_;
  int rows_;
  std::size_t row_size_;  // bytes, padding included
  bool can_seek_;
  // Rows that wait to be written, in the order of the file: a BMP's block is filled from its end.
  std::vector<char> block_;
  std::size_t waiting_row_count_ = 0;
  std::size_t written_row_count_ = 0;
  std::optional<PngWriter> png_;
};

}  // namespace pipeline
