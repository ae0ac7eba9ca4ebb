#include "libpipeline/picture/pixel_files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>

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
  // Halves keep the difference of two large limits finite; used only for these, as half of the smallest
  // double is 0.
  const double scale = std::isfinite(screen.rear - screen.front) ? 1 : 0.5;
  const double rear = scale * screen.rear;
  const double nearness = (rear - scale * depth) / (rear - scale * screen.front);
  return static_cast<std::uint16_t>(std::floor(std::clamp(nearness, 0.0, 1.0) * 65535 + 0.5));
}

}  // namespace

void check_depth_image_name(const std::string& path) {
  is_png(path);
}

std::unique_ptr<RowWriter<double>> depth_image_writer(int descriptor, const std::string& path,
                                                      const Viewport& screen) {
  const auto writer = is_png(path) ? png_writer : netpbm_writer;
  const auto convert = [screen](double depth, unsigned char* out) {
    const std::uint16_t brightness = depth_brightness(depth, screen);
    *out++ = static_cast<unsigned char>(brightness >> 8);
    *out++ = static_cast<unsigned char>(brightness & 0xff);
    return out;
  };
  return std::make_unique<ConvertingWriter<double, decltype(convert)>>(
      writer(descriptor, path, PixelBytes::gray16, screen.columns, screen.drawn_row_count()), convert);
}

void check_array_name(const std::string& path) {
  if (extension_of(path) != ".npy" && !is_device_without_extension(path))
    reject_extension(path, "an array file", {".npy"});
}

template <typename Number>
std::unique_ptr<RowWriter<Number>> array_writer(int descriptor, const std::string& path,
                                                const Viewport& screen) {
  static_assert(sizeof(Number) == 8 && std::endian::native == std::endian::little);
  std::string description = std::string("{'descr': '") + (std::is_floating_point_v<Number> ? "<f8" : "<i8") +
                            "', 'fortran_order': False, 'shape': (" +
                            std::to_string(screen.drawn_row_count()) + ", " + std::to_string(screen.columns) +
                            "), }";
  // The numbers begin at a multiple of 64, after a line feed; ten bytes come before the description.
  constexpr std::size_t kStart = 128;
  description.resize(kStart - 11, ' ');
  const std::string length = {static_cast<char>(kStart - 10), '\0'};
  return std::make_unique<PlainWriter<Number>>(
      descriptor, path, std::string("\x93NUMPY\x01\0", 8) + length + description + "\n");
}
template std::unique_ptr<RowWriter<double>> array_writer(int, const std::string&, const Viewport&);
template std::unique_ptr<RowWriter<std::int64_t>> array_writer(int, const std::string&, const Viewport&);

}  // namespace pipeline
