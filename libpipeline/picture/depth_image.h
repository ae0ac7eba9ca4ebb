#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "libpipeline/picture/netpbm_file.h"
#include "libpipeline/picture/png_file.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// An InputError unless the file's extension, in upper or lower case, names a format of depth images: .pgm
/// (Netpbm P5) or, where can_write_png(), .png, both with 16 bits of gray. A device's name (/dev/stdout) gets
/// PGM.
void check_depth_image_name(const std::string& path);

/// The brightness of a depth: 65535 at the front limit, 0 at the rear limit and where nothing is seen, linear
/// in between, rounded to the nearest integer, halves up.
std::uint16_t depth_brightness(double depth, const Viewport& screen);

/// Takes the depths of an image row by row, from the top, and writes them as brightness. Failures to write
/// are IoErrors.
class DepthImageWriter {
 public:
  /// Writes to a file descriptor, which the caller keeps and closes; `path` chooses the format and names the
  /// file in messages.
  DepthImageWriter(int descriptor, const std::string& path, const Viewport& screen);

  /// Takes the depths (NDC z) of the next row, from the left.
  void write_row(std::span<const double> depths);
  /// Writes the rows still buffered; to be called after the last row.
  void finish();

 private:
  Viewport screen_;
  std::variant<NetpbmWriter, PngWriter> file_;
  std::vector<unsigned char> row_;
};

}  // namespace pipeline
