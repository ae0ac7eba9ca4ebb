#include "libpipeline/picture/depth_image.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/picture/image_file.h"

namespace pipeline {
namespace {

using Gray16Writer = std::variant<NetpbmWriter, PngWriter>;

bool is_png(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".pgm" || is_device_without_extension(path)) return false;
  if (extension == ".png" && can_write_png()) return true;
  if (can_write_png()) reject_extension(path, "a depth image file", {".pgm", ".png"});
  reject_extension(path, "a depth image file", {".pgm"});
}

Gray16Writer writer_for(int descriptor, const std::string& path, const Viewport& screen) {
  const auto make = [&]<typename Writer>(std::in_place_type_t<Writer> type) {
    return Gray16Writer(type, descriptor, path, PixelBytes::gray16, screen.columns, screen.drawn_row_count());
  };
  return is_png(path) ? make(std::in_place_type<PngWriter>) : make(std::in_place_type<NetpbmWriter>);
}

}  // namespace

void check_depth_image_name(const std::string& path) {
  is_png(path);
}

std::uint16_t depth_brightness(double depth, const Viewport& screen) {
  // Halves, so that the difference of two large limits stays finite; but only there, as the half of the
  // smallest double is 0.
  const double scale = std::isfinite(screen.rear - screen.front) ? 1 : 0.5;
  const double rear = scale * screen.rear;
  const double nearness = (rear - scale * depth) / (rear - scale * screen.front);
  return static_cast<std::uint16_t>(std::floor(std::clamp(nearness, 0.0, 1.0) * 65535 + 0.5));
}

DepthImageWriter::DepthImageWriter(int descriptor, const std::string& path, const Viewport& screen)
    : screen_(screen), file_(writer_for(descriptor, path, screen)) {}

void DepthImageWriter::write_row(std::span<const double> depths) {
  row_.clear();
  for (const double depth : depths) {
    const std::uint16_t brightness = depth_brightness(depth, screen_);
    row_.push_back(static_cast<unsigned char>(brightness >> 8));
    row_.push_back(static_cast<unsigned char>(brightness & 0xff));
  }
  std::visit([&](auto& file) { file.write_row(row_); }, file_);
}

void DepthImageWriter::finish() {
  std::visit([](auto& file) { file.finish(); }, file_);
}

}  // namespace pipeline
