#include "libpipeline/picture/image_file.h"

#include <algorithm>
#include <cassert>
#include <filesystem>

#include "libpipeline/picture/image_formats.h"
#include "libpipeline/scene/spelling.h"
#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

/// Writes formats with rows from the top and red first, by a writer of bytes.
template <auto byte_writer, PixelBytes pixels = PixelBytes::rgb8>
class RgbWriter final : public ImageWriter {
 public:
  RgbWriter(int descriptor, const std::string& path, int columns, int rows)
      : rows_(byte_writer(descriptor, path, pixels, columns, rows)),
        bytes_(kBytesPerPixel * static_cast<std::size_t>(columns)) {}

  void write_row(std::span<const Color> colors) override {
    assert(kBytesPerPixel * colors.size() == bytes_.size());
    unsigned char* out = bytes_.data();
    for (const Color color : colors) {
      *out++ = color.red();
      *out++ = color.green();
      *out++ = color.blue();
      if (kBytesPerPixel == 4) *out++ = color.alpha();
    }
    rows_->write_row(bytes_);
  }
  void finish() override { rows_->finish(); }

 private:
  static constexpr std::size_t kBytesPerPixel = pixels == PixelBytes::rgba8 ? 4 : 3;

  std::unique_ptr<ByteWriter> rows_;
  std::vector<unsigned char> bytes_;
};

struct ImageFormat {
  std::string_view extension;
  std::unique_ptr<ImageWriter> (*writer)(int descriptor, const std::string& path, int columns, int rows);
  void (*check_size)(const std::string& path, int columns, int rows);
};

template <auto byte_writer, PixelBytes pixels = PixelBytes::rgb8>
std::unique_ptr<ImageWriter> make(int descriptor, const std::string& path, int columns, int rows) {
  return std::make_unique<RgbWriter<byte_writer, pixels>>(descriptor, path, columns, rows);
}

void take_any_size(const std::string&, int, int) {}

constexpr ImageFormat kPpm = {".ppm", make<netpbm_writer>, take_any_size};
constexpr ImageFormat kFormats[] = {{".bmp", bmp_writer, check_bmp_size}, kPpm};
// Used only with libpng.
constexpr ImageFormat kPng = {".png", make<png_writer>, take_any_size};

/// ".png" of "png:FILE"; empty without a prefix that names a format.
std::string prefix_of(const std::string& path) {
  const std::size_t colon = path.find(':');
  if (colon == std::string::npos) return {};
  const std::string extension = "." + path.substr(0, colon);
  const auto is_it = [&](const ImageFormat& format) { return format.extension == extension; };
  return is_it(kPng) || std::ranges::any_of(kFormats, is_it) ? extension : std::string();
}

/// The extension that names the format, as a prefix or at the end.
std::string format_extension_of(const std::string& path) {
  if (std::string prefix = prefix_of(path); !prefix.empty()) return prefix;
  return is_device_without_extension(path) ? std::string(kPpm.extension) : extension_of(path);
}

const ImageFormat& format_of(const std::string& path) {
  const std::string extension = format_extension_of(path);
  if (image_file_of(path).empty())
    throw InputError({path}, expected_but_found("a file name after the format", "nothing"));
  if (extension == ".bmp" && is_device_without_extension(image_file_of(path))) {
    const std::string shown = path == "bmp:/dev/stdout" ? "bmp:-" : path;
    throw InputError({shown}, expected_but_found("ppm:- or png:-, as a BMP is written from its end",
                                                 pipeline::quoted(shown)));
  }
  for (const ImageFormat& format : kFormats)
    if (format.extension == extension) return format;
  if (can_write_png() && kPng.extension == extension) return kPng;
  reject_extension(path, "an image file", image_extensions());
}

}  // namespace

std::vector<std::string_view> image_extensions() {
  std::vector<std::string_view> extensions;
  for (const ImageFormat& format : kFormats) extensions.push_back(format.extension);
  if (can_write_png()) extensions.push_back(kPng.extension);
  return extensions;
}

std::string image_file_of(const std::string& path) {
  return path.substr(prefix_of(path).size());
}

void check_image_name(const std::string& path) {
  format_of(path);
}

void check_image_size(const std::string& path, int columns, int rows) {
  format_of(path).check_size(path, columns, rows);
}

bool can_hold_alpha(const std::string& path) {
  return can_write_png() && format_extension_of(path) == kPng.extension;
}

std::unique_ptr<ImageWriter> image_writer(int descriptor, const std::string& path, int columns, int rows,
                                          bool has_alpha) {
  assert(!has_alpha || can_hold_alpha(path));
  const std::string file = image_file_of(path);
  if (has_alpha) return make<png_writer, PixelBytes::rgba8>(descriptor, file, columns, rows);
  return format_of(path).writer(descriptor, file, columns, rows);
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
  throw InputError({path}, expected_but_found(expected, found.empty() ? "a name without extension"
                                                                      : pipeline::quoted(found)));
}

}  // namespace pipeline
