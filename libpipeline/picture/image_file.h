#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "libpipeline/scene/color.h"

namespace pipeline {

/// Takes a picture row by row, from the top, and writes it in some format to a file descriptor, which the
/// caller keeps and closes. Failures to write are IoErrors, which name the file by its path.
template <typename Pixel>
class RowWriter {
 public:
  RowWriter() = default;
  virtual ~RowWriter() = default;
  RowWriter(const RowWriter&) = delete;
  RowWriter& operator=(const RowWriter&) = delete;

  /// Takes the next row, all its pixels from the left.
  virtual void write_row(std::span<const Pixel> pixels) = 0;
  /// Writes the rows still buffered; to be called after the last row.
  virtual void finish() = 0;
};
using ImageWriter = RowWriter<Color>;

// The extension of a file's name, in upper or lower case, chooses the format: BMP (24 bits per pixel, at most
// 4 GiB), PPM (Netpbm P6) or, where can_write_png(), PNG (8 bits per channel). A device's name (/dev/null,
// /dev/stdout) has none: it gets PPM, which can be written sequentially. Any other name is an InputError, and
// so is an image larger than the format holds. A prefix "png:", "ppm:" or "bmp:" chooses the format whatever
// the name of the file is, but BMP, which is written from its end, needs a file.

/// The extensions of all formats that can be written: ".bmp", ...
std::vector<std::string_view> image_extensions();

/// The name of the file, without the prefix.
std::string image_file_of(const std::string& path);

/// Throws these errors.
void check_image_name(const std::string& path);
void check_image_size(const std::string& path, int columns, int rows);

/// True if an image of that name can hold the alpha of its pixels: PNG only.
bool can_hold_alpha(const std::string& path);

/// The writer of an image, whose format `path` chooses. With alpha only where can_hold_alpha(path); it is
/// straight: colors are not multiplied by it. Throws like the checks.
std::unique_ptr<ImageWriter> image_writer(int descriptor, const std::string& path, int columns, int rows,
                                          bool has_alpha = false);

// For image files of any kind.

/// The extension of a file's name in lower case: ".bmp".
std::string extension_of(const std::string& path);
/// True for names like /dev/null, which have no extension to choose a format.
bool is_device_without_extension(const std::string& path);
/// Throws the InputError that names the extensions a file of this kind ("an image file") may have.
[[noreturn]] void reject_extension(const std::string& path, const std::string& kind,
                                   const std::vector<std::string_view>& extensions);

}  // namespace pipeline
