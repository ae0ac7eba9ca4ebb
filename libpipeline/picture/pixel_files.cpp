#include "libpipeline/picture/pixel_files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "libpipeline/picture/image_formats.h"
#include "libpipeline/text/text_writer.h"

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
  // Halves keep the difference of two large limits finite; used only for these, as half of the smallest
  // double is 0.
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

static_assert(std::endian::native == std::endian::little);

template <typename Number>
class ArrayWriter final : public RowWriter<Number> {
 public:
  ArrayWriter(int descriptor, const std::string& path, const Viewport& screen) : file_(descriptor, path) {
    static_assert(sizeof(Number) == 8);
    const std::string kind = std::is_floating_point_v<Number> ? "<f8" : "<i8";
    std::string description = "{'descr': '" + kind + "', 'fortran_order': False, 'shape': (" +
                              std::to_string(screen.drawn_row_count()) + ", " +
                              std::to_string(screen.columns) + "), }";
    // The numbers begin at a multiple of 64, after a line feed; ten bytes come before the description.
    constexpr std::size_t kStart = 128;
    description.resize(kStart - 11, ' ');
    const char length = static_cast<char>(kStart - 10);
    file_.append(std::string("\x93NUMPY\x01\0", 8) + length + std::string(1, '\0') + description + "\n");
  }

  void write_row(std::span<const Number> numbers) override {
    file_.append({reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes()});
  }
  void finish() override { file_.flush(); }

 private:
  TextWriter file_;
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

void check_array_name(const std::string& path) {
  if (extension_of(path) != ".npy" && !is_device_without_extension(path))
    reject_extension(path, "an array file", {".npy"});
}

template <typename Number>
std::unique_ptr<RowWriter<Number>> array_writer(int descriptor, const std::string& path,
                                                const Viewport& screen) {
  return std::make_unique<ArrayWriter<Number>>(descriptor, path, screen);
}
template std::unique_ptr<RowWriter<double>> array_writer(int, const std::string&, const Viewport&);
template std::unique_ptr<RowWriter<std::int64_t>> array_writer(int, const std::string&, const Viewport&);

}  // namespace pipeline
