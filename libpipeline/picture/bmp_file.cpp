#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "libpipeline/picture/image_formats.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {
namespace {

constexpr std::size_t kHeaderSize = 14 + 40;
constexpr std::size_t kBlockSize = std::size_t{1} << 16;

/// The bytes of one row in the file; rows start at multiples of four.
std::size_t row_size(int columns) {
  return (3 * static_cast<std::size_t>(columns) + 3) / 4 * 4;
}

/// True if written bytes go to the position of the last seek.
bool can_seek(int descriptor) {
  const int flags = ::fcntl(descriptor, F_GETFL);
  return flags >= 0 && (flags & O_APPEND) == 0 && ::lseek(descriptor, 0, SEEK_CUR) == 0;
}

class BmpWriter final : public ImageWriter {
 public:
  BmpWriter(int descriptor, const std::string& path, int columns, int rows)
      : descriptor_(descriptor),
        path_(path),
        columns_(static_cast<std::size_t>(columns)),
        rows_(static_cast<std::size_t>(rows)),
        row_size_(row_size(columns)),
        can_seek_(can_seek(descriptor)) {
    check_bmp_size(path, columns, rows);
    write_header();
    const std::size_t rows_at_once = std::clamp<std::size_t>(kBlockSize / row_size_, 1, rows_);
    block_.resize(row_size_ * (can_seek_ ? rows_at_once : rows_));
  }

  void write_row(std::span<const Color> colors) override {
    assert(colors.size() == columns_);
    if (buffered_row_count_ == block_rows()) write_block();
    char* out = block_.data() + row_size_ * (block_rows() - ++buffered_row_count_);
    // Blue, green, red, as processors are little-endian (eight_digits.h); the next color replaces a fourth
    // byte.
    for (const Color color : colors.first(columns_ - 1)) {
      std::memcpy(out, &color, sizeof color);
      out += 3;
    }
    std::memcpy(out, &colors.back(), 3);
  }
  void finish() override {
    write_block();
    assert(written_row_count_ == rows_);
  }

 private:
  [[nodiscard]] std::size_t block_rows() const { return block_.size() / row_size_; }

  // T24
  void write_header() {
    constexpr auto kHeader = static_cast<std::uint32_t>(kHeaderSize);
    const auto pixels_size = static_cast<std::uint32_t>(row_size_ * rows_);
    const std::array<std::uint32_t, 13> numbers = {
        kHeader + pixels_size,
        0,        // reserved
        kHeader,  // where the pixels start
        40,       // size of the second header, BITMAPINFOHEADER
        static_cast<std::uint32_t>(columns_),
        static_cast<std::uint32_t>(rows_),  // positive: from the bottom
        1 | 24 << 16,                       // planes, bits per pixel
        0,                                  // not compressed
        pixels_size,
    };  // unspecified, 0: pixels per meter in x and y, palette size, important colors
    std::string header = "BM";
    header.append(reinterpret_cast<const char*>(numbers.data()), sizeof numbers);
    write_all(descriptor_, header, path_);
  }

  void write_block() {
    const std::size_t size = buffered_row_count_ * row_size_;
    written_row_count_ += std::exchange(buffered_row_count_, 0);
    const std::size_t position = kHeaderSize + (rows_ - written_row_count_) * row_size_;
    if (can_seek_ && ::lseek(descriptor_, static_cast<off_t>(position), SEEK_SET) < 0)
      throw IoError("write", path_, errno);
    write_all(descriptor_, {block_.data() + block_.size() - size, size}, path_);
  }

  int descriptor_;
  std::string path_;
  std::size_t columns_, rows_;
  std::size_t row_size_;  // bytes, padding included
  bool can_seek_;
  // Rows not yet written, in the order of the file, so filled from the end.
  std::vector<char> block_;
  std::size_t buffered_row_count_ = 0;
  std::size_t written_row_count_ = 0;
};

}  // namespace

void check_bmp_size(const std::string& path, int columns, int rows) {
  const std::uint64_t size = kHeaderSize + std::uint64_t{row_size(columns)} * static_cast<unsigned>(rows);
  if (size <= std::numeric_limits<std::uint32_t>::max()) return;
  throw InputError(
      {path}, "an image that fits into the 4 GiB of a .bmp file (--image FILE.ppm has no such limit)",
      std::to_string(columns) + " x " + std::to_string(rows) + " pixels, " + std::to_string(size) + " bytes");
}

std::unique_ptr<ImageWriter> bmp_writer(int descriptor, const std::string& path, int columns, int rows) {
  return std::make_unique<BmpWriter>(descriptor, path, columns, rows);
}

}  // namespace pipeline
