#include "libpipeline/picture/image_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <filesystem>

#include "libpipeline/picture/image_formats.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

// The last needs libpng.
constexpr std::array<std::string_view, 3> kExtensions = {".bmp", ".ppm", ".png"};

/// ".png" of "png:FILE"; empty without a prefix that names a format.
std::string prefix_of(const std::string& path) {
  const std::size_t colon = path.find(':');
  if (colon == std::string::npos) return {};
  const std::string extension = "." + path.substr(0, colon);
  return std::ranges::find(kExtensions, extension) != kExtensions.end() ? extension : std::string();
}

/// The extension that names the format, as a prefix or at the end.
std::string format_extension_of(const std::string& path) {
  if (std::string prefix = prefix_of(path); !prefix.empty()) return prefix;
  return is_device_without_extension(path) ? ".ppm" : extension_of(path);
}

/// The extension likewise; throws the InputErrors of a name.
std::string format_of(const std::string& path) {
  std::string extension = format_extension_of(path);
  if (image_file_of(path).empty()) throw InputError({path}, "a file name after the format", "nothing");
  if (extension == ".bmp" && is_device_without_extension(image_file_of(path))) {
    const std::string shown = path == "bmp:/dev/stdout" ? "bmp:-" : path;
    throw InputError({shown}, "ppm:- or png:-, as a BMP is written from its end", pipeline::quoted(shown));
  }
  const std::vector<std::string_view> extensions = image_extensions();
  if (std::ranges::find(extensions, extension) == extensions.end())
    reject_extension(path, "an image file", extensions);
  return extension;
}

}  // namespace

std::vector<std::string_view> image_extensions() {
  return {kExtensions.begin(), kExtensions.end() - (can_write_png() ? 0 : 1)};
}

std::string image_file_of(const std::string& path) {
  return path.substr(prefix_of(path).size());
}

void check_image_name(const std::string& path) {
  format_of(path);
}

void check_image_size(const std::string& path, int columns, int rows) {
  if (format_of(path) == ".bmp") check_bmp_size(path, columns, rows);
}

bool can_hold_alpha(const std::string& path) {
  return can_write_png() && format_extension_of(path) == ".png";
}

std::unique_ptr<ImageWriter> image_writer(int descriptor, const std::string& path, int columns, int rows,
                                          bool has_alpha) {
  assert(!has_alpha || can_hold_alpha(path));
  const std::string file = image_file_of(path), format = format_of(path);
  if (format == ".bmp") return bmp_writer(descriptor, file, columns, rows);
  const auto byte_writer = format == ".png" ? png_writer : netpbm_writer;
  const PixelBytes pixels = has_alpha ? PixelBytes::rgba8 : PixelBytes::rgb8;
  const auto convert = [has_alpha](Color color, unsigned char* out) {
    *out++ = color.red();
    *out++ = color.green();
    *out++ = color.blue();
    if (has_alpha) *out++ = color.alpha();
    return out;
  };
  return std::make_unique<ConvertingWriter<Color, decltype(convert)>>(
      byte_writer(descriptor, file, pixels, columns, rows), convert);
}

std::string extension_of(const std::string& path) {
  return in_lower_case(std::filesystem::path(path).extension().string());
}

bool is_device_without_extension(const std::string& path) {
  return path.starts_with("/dev/") && extension_of(path).empty();
}

void reject_extension(const std::string& path, const std::string& kind,
                      const std::vector<std::string_view>& extensions) {
  const std::string found = std::filesystem::path(path).extension().string();
  std::string expected = kind + " that ends in " + listed(extensions);
  if (!can_write_png() && extension_of(path) == ".png")
    expected += " (this build is without libpng, which .png needs)";
  throw InputError({path}, expected, found.empty() ? "a name without extension" : pipeline::quoted(found));
}

}  // namespace pipeline
