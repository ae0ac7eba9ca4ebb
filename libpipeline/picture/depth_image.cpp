#include "libpipeline/picture/depth_image.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/text/error.h"

namespace pipeline {

DepthImageFormat depth_image_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".pgm" || is_device_without_extension(path)) return DepthImageFormat::pgm;
  if (extension == ".png" && can_write_png()) return DepthImageFormat::png;
  reject_extension(path, "a depth image file", ".pgm");
}

std::uint16_t depth_brightness(double depth, const Viewport& screen) {
  // Halves, so that the difference of two large limits stays finite.
  const double nearness = (screen.rear / 2 - depth / 2) / (screen.rear / 2 - screen.front / 2);
  return static_cast<std::uint16_t>(std::floor(std::clamp(nearness, 0.0, 1.0) * 65535 + 0.5));
}

DepthImageWriter::DepthImageWriter(int descriptor, const std::string& path, const Viewport& screen)
    : screen_(screen), pgm_(descriptor, path) {
  if (depth_image_format_of(path) == DepthImageFormat::png)
    png_.emplace(descriptor, path, PngPixels::gray16, screen.columns, screen.rows);
  else
    pgm_.append("P5\n" + std::to_string(screen.columns) + " " + std::to_string(screen.rows) + "\n65535\n");
}

void DepthImageWriter::write_row(std::span<const double> depths) {
  row_.clear();
  for (const double depth : depths) {
    const std::uint16_t brightness = depth_brightness(depth, screen_);
    row_.push_back(static_cast<unsigned char>(brightness >> 8));
    row_.push_back(static_cast<unsigned char>(brightness & 0xff));
  }
  if (png_)
    png_->write_row(row_);
  else
    pgm_.append({reinterpret_cast<const char*>(row_.data()), row_.size()});
}

void DepthImageWriter::finish() {
  if (png_)
    png_->finish();
  else
    pgm_.flush();
}

}  // namespace pipeline
