#include "libpipeline/picture/image_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <string_view>

#include "libpipeline/text/error.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {
namespace {

constexpr std::size_t kBmpHeaderSize = 14 + 40;
constexpr std::size_t kBlockSize = std::size_t{1} << 22;

char to_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Bytes of one row in the file; a BMP's rows start at multiples of four.
std::size_t row_size(ImageFormat format, int columns) {
  const std::size_t size = 3 * static_cast<std::size_t>(columns);
  return format == ImageFormat::bmp ? (size + 3) / 4 * 4 : size;
}

/// True where every byte written goes where the last seek said.
bool can_seek(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  return flags >= 0 && (flags & O_APPEND) == 0 && ::lseek(descriptor, 0, SEEK_CUR) == 0;
}

template <typename UInt>
void append_little_endian(std::string& bytes, UInt value) {
  for (std::size_t i = 0; i < sizeof value; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
}

}  // namespace

std::string extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), to_lower);
  return extension;
}

bool is_device_without_extension(const std::string& path) {
  return path.starts_with("/dev/") && extension_of(path).empty();
}

void reject_extension(const std::string& path, const std::string& kind, const std::string& formats) {
  const std::string found = std::filesystem::path(path).extension().string();
  std::string expected = kind + " that ends in " + formats;
  if (can_write_png())
    expected += " or .png";
  else if (extension_of(path) == ".png")
    expected += " (this build is without libpng, which .png needs)";
  throw InputError({path}, expected_but_found(expected, found.empty() ? "a name without extension"
                                                                      : pipeline::quoted(found)));
}

ImageFormat image_format_of(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension == ".bmp") return ImageFormat::bmp;
  if (extension == ".ppm" || is_device_without_extension(path)) return ImageFormat::ppm;
  if (extension == ".png" && can_write_png()) return ImageFormat::png;
  reject_extension(path, "an image file", can_write_png() ? ".bmp, .ppm" : ".bmp or .ppm");
}

void check_image_size(ImageFormat format, int columns, int rows, const std::string& path) {
  if (format != ImageFormat::bmp) return;
  const std::uint64_t size =
      kBmpHeaderSize + std::uint64_t{row_size(format, columns)} * static_cast<unsigned>(rows);
  if (size <= std::numeric_limits<std::uint32_t>::max()) return;
  throw InputError(
      {path}, expected_but_found(
                  "an image that fits into the 4 GiB of a .bmp file (--image FILE.ppm has no such limit)",
                  std::to_string(columns) + " x " + std::to_string(rows) + " pixels, " +
                      std::to_string(size) + " bytes"));
}

ImageWriter::ImageWriter(int descriptor, const std::string& path, ImageFormat format, int columns, int rows)
    : descriptor_(descriptor),
      path_(path),
      format_(format),
      columns_(columns),
      rows_(rows),
      row_size_(row_size(format, columns)),
      can_seek_(can_seek(descriptor)) {
  check_image_size(format, columns, rows, path);
  if (format == ImageFormat::bmp)
    write_bmp_header();
  else if (format == ImageFormat::png)
    png_.emplace(descriptor, path, PngPixels::rgb8, columns, rows);
  else
    write_all(descriptor_, "P6\n" + std::to_string(columns) + " " + std::to_string(rows) + "\n255\n", path_);
  const bool needs_all_rows = format == ImageFormat::bmp && !can_seek_;
  const std::size_t all_rows = static_cast<std::size_t>(rows);
  const std::size_t block_rows = png_ ? 1 : std::clamp<std::size_t>(kBlockSize / row_size_, 1, all_rows);
  block_.resize(row_size_ * (needs_all_rows ? all_rows : block_rows));
}

void ImageWriter::write_bmp_header() {
  const auto pixels_size = static_cast<std::uint32_t>(row_size_ * static_cast<std::size_t>(rows_));
  const auto header_size = static_cast<std::uint32_t>(kBmpHeaderSize);
  std::string header = "BM";
  append_little_endian(header, header_size + pixels_size);
  append_little_endian(header, std::uint32_t{0});   // reserved
  append_little_endian(header, header_size);        // where the pixels start
  append_little_endian(header, std::uint32_t{40});  // size of the second header, BITMAPINFOHEADER
  append_little_endian(header, static_cast<std::uint32_t>(columns_));
  append_little_endian(header, static_cast<std::uint32_t>(rows_));  // positive: from the bottom
  append_little_endian(header, std::uint16_t{1});                   // planes
  append_little_endian(header, std::uint16_t{24});                  // bits a pixel
  append_little_endian(header, std::uint32_t{0});                   // not compressed
  append_little_endian(header, pixels_size);
  header.append(16, '\0');  // pixels per meter in x and y, colors in the palette, important ones: not said
  write_all(descriptor_, header, path_);
}

char* ImageWriter::place_for_next_row() {
  const std::size_t block_rows = block_.size() / row_size_;
  if (waiting_row_count_ == block_rows) write_rows();
  const std::size_t index = waiting_row_count_++;
  return block_.data() + row_size_ * (format_ == ImageFormat::bmp ? block_rows - 1 - index : index);
}

void ImageWriter::write_row(std::span<const Color> colors) {
  assert(colors.size() == static_cast<std::size_t>(columns_));
  char* out = place_for_next_row();
  for (const Color color : colors) {
    const bool is_bmp = format_ == ImageFormat::bmp;
    *out++ = static_cast<char>(is_bmp ? color.blue() : color.red());
    *out++ = static_cast<char>(color.green());
    *out++ = static_cast<char>(is_bmp ? color.red() : color.blue());
  }
}

void ImageWriter::write_rows() {
  const std::size_t size = waiting_row_count_ * row_size_;
  std::string_view bytes(block_.data(), size);
  written_row_count_ += waiting_row_count_;
  waiting_row_count_ = 0;
  if (format_ == ImageFormat::bmp) {
    bytes = {block_.data() + block_.size() - size, size};
    const std::size_t rows_below = static_cast<std::size_t>(rows_) - written_row_count_;
    if (can_seek_ &&
        ::lseek(descriptor_, static_cast<off_t>(kBmpHeaderSize + rows_below * row_size_), SEEK_SET) < 0)
      throw IoError("write", path_, errno);
  }
  if (png_)
    png_->write_row({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
  else
    write_all(descriptor_, bytes, path_);
}

void ImageWriter::finish() {
  write_rows();
  if (png_) png_->finish();
  assert(written_row_count_ == static_cast<std::size_t>(rows_));
}

}  // namespace pipeline
