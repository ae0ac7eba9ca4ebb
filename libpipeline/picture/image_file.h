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
// /dev/stdout) has none and gets PPM, which can be written sequentially. Any other name is an InputError, as
// is an image too large for the format. A prefix "png:", "ppm:" or "bmp:" chooses the format for any file
// name, but BMP, which is written from its end, needs a file.

/// The extensions of all formats that can be written: ".bmp", ...
std::vector<std::string_view> image_extensions();

/// The name of the file, without the prefix.
std::string image_file_of(const std::string& path);

/// These two throw the errors above.
void check_image_name(const std::string& path);
void check_image_size(const std::string& path, int columns, int rows);

/// True if the format that `path` chooses has an alpha: only PNG does.
bool can_hold_alpha(const std::string& path);

/// The writer of an image in the format that `path` chooses. `has_alpha` needs can_hold_alpha(path); alpha is
/// straight: colors are not multiplied by it. Throws like the checks.
std::unique_ptr<ImageWriter> image_writer(int descriptor, const std::string& path, int columns, int rows,
                                          bool has_alpha = false);

// The functions below are for image files of any kind.

/// The extension of a file's name in lower case: ".bmp".
std::string extension_of(const std::string& path);
/// True for names like /dev/null, without an extension that chooses a format.
bool is_device_without_extension(const std::string& path);
/// Throws the InputError that lists the extensions allowed for this kind of file ("an image file").
[[noreturn]] void reject_extension(const std::string& path, const std::string& kind,
                                   const std::vector<std::string_view>& extensions);

}  // namespace pipeline
