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

/// A writer of depths (NDC z) as brightness, as an ImageWriter of colors; `path` chooses the format.
class DepthImageWriter {
 public:
  DepthImageWriter(int descriptor, const std::string& path, const Viewport& screen);
  void write_row(std::span<const double> depths);
  void finish();

 private:
  Viewport screen_;
  std::variant<NetpbmWriter, PngWriter> file_;
  std::vector<unsigned char> row_;
};

}  // namespace pipeline
