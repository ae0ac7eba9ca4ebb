#include "libpipeline/picture/depth_image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "libpipeline/picture/image_formats.h"

namespace pipeline {
namespace {

bool is_png(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".pgm" || is_device_without_extension(path)) return false;
  if (extension == ".png" && can_write_png()) return true;
  if (can_write_png()) reject_extension(path, "a depth image file", {".pgm", ".png"});
  reject_extension(path, "a depth image file", {".pgm"});
}

std::uint16_t depth_brightness(double depth, const Viewport& screen) {
  // Halves, so that the difference of two large limits stays finite; but only there, as the half of the
  // smallest double is 0.
  const double scale = std::isfinite(screen.rear - screen.front) ? 1 : 0.5;
  const double rear = scale * screen.rear;
  const double nearness = (rear - scale * depth) / (rear - scale * screen.front);
  return static_cast<std::uint16_t>(std::floor(std::clamp(nearness, 0.0, 1.0) * 65535 + 0.5));
}

class DepthImageWriter final : public RowWriter<double> {
 public:
  DepthImageWriter(std::unique_ptr<ByteWriter> file, const Viewport& screen)
      : screen_(screen), file_(std::move(file)) {}

  void write_row(std::span<const double> depths) override {
    row_.clear();
    for (const double depth : depths) {
      const std::uint16_t brightness = depth_brightness(depth, screen_);
      row_.push_back(static_cast<unsigned char>(brightness >> 8));
      row_.push_back(static_cast<unsigned char>(brightness & 0xff));
    }
    file_->write_row(row_);
  }
  void finish() override { file_->finish(); }

 private:
  Viewport screen_;
  std::unique_ptr<ByteWriter> file_;
  std::vector<unsigned char> row_;
};

}  // namespace

void check_depth_image_name(const std::string& path) {
  is_png(path);
}

std::unique_ptr<RowWriter<double>> depth_image_writer(int descriptor, const std::string& path,
                                                      const Viewport& screen) {
  const auto writer = is_png(path) ? png_writer : netpbm_writer;
  return std::make_unique<DepthImageWriter>(
      writer(descriptor, path, PixelBytes::gray16, screen.columns, screen.drawn_row_count()), screen);
}

}  // namespace pipeline
