#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/picture/png_file.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

enum class DepthImageFormat {
  pgm,  // Netpbm P5, 16 bits, the high byte first
  png,  // 16 bits of gray; only where can_write_png()
};

/// The format a file's extension stands for, upper or lower case; a device's name (/dev/stdout) gets PGM. Any
/// other name is an InputError, and so is .png where there is no libpng.
DepthImageFormat depth_image_format_of(const std::string& path);

/// How bright a depth is: 65535 at the front limit, 0 at the rear limit and where nothing is seen, linear
/// between and rounded to the nearest, halves up.
std::uint16_t depth_brightness(double depth, const Viewport& screen);

/// Takes the depths of an image row by row, from the top, and writes them as brightness. Failures to write
/// are IoErrors.
class DepthImageWriter {
 public:
  /// Writes to a file descriptor, which stays the caller's; `path` names it in messages and says the format.
  DepthImageWriter(int descriptor, const std::string& path, const Viewport& screen);

  /// Takes the depths (NDC z) of the next row, from the left.
  void write_row(std::span<const double> depths);
  /// Writes what is not written yet; to be called after the last row.
  void finish();

 private:
  Viewport screen_;
  TextWriter pgm_;
  std::optional<PngWriter> png_;
  std::vector<unsigned char> row_;
};

}  // namespace pipeline
