#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <limits>
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

/// Writes four pixels, blue, green and red each, to `out`; returns their end. Processors are little-endian
/// (eight_digits.h).
char* append_four(const Color* colors, char* out) {
  const std::uint32_t a = colors[0].rgb(), b = colors[1].rgb(), c = colors[2].rgb(), d = colors[3].rgb();
  for (const std::uint32_t bytes : {a | b << 24, b >> 8 | c << 16, c >> 16 | d << 8}) {
    std::memcpy(out, &bytes, sizeof bytes);
    out += sizeof bytes;
  }
  return out;
}

class BmpWriter final : public ImageWriter {
 public:
  BmpWriter(int descriptor, const std::string& path, int columns, int rows);

  void write_row(std::span<const Color> colors) override;
  void finish() override;

 private:
  [[nodiscard]] std::size_t block_rows() const { return block_.size() / row_size_; }
  void write_header();
  void write_block();

  int descriptor_;
  std::string path_;
  int columns_;
  int rows_;
  std::size_t row_size_;  // bytes, padding included
  bool can_seek_;
  // Rows not yet written, in the order of the file, so filled from the end.
  std::vector<char> block_;
  std::size_t buffered_row_count_ = 0;
  std::size_t written_row_count_ = 0;
};

BmpWriter::BmpWriter(int descriptor, const std::string& path, int columns, int rows)
    : descriptor_(descriptor),
      path_(path),
      columns_(columns),
      rows_(rows),
      row_size_(row_size(columns)),
      can_seek_(can_seek(descriptor)) {
  check_bmp_size(path, columns, rows);
  write_header();
  const std::size_t all_rows = static_cast<std::size_t>(rows);
  const std::size_t rows_at_once = std::clamp<std::size_t>(kBlockSize / row_size_, 1, all_rows);
  block_.resize(row_size_ * (can_seek_ ? rows_at_once : all_rows));
}

// T24
void BmpWriter::write_header() {
  const auto pixels_size = static_cast<std::uint32_t>(row_size_ * static_cast<std::size_t>(rows_));
  const auto header_size = static_cast<std::uint32_t>(kHeaderSize);
  const std::array<std::uint32_t, 13> numbers = {
      header_size + pixels_size,
      0,            // reserved
      header_size,  // where the pixels start
      40,           // size of the second header, BITMAPINFOHEADER
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

void BmpWriter::write_row(std::span<const Color> colors) {
  assert(colors.size() == static_cast<std::size_t>(columns_));
  if (buffered_row_count_ == block_rows()) write_block();
  char* out = block_.data() + row_size_ * (block_rows() - ++buffered_row_count_);
  for (; colors.size() >= 4; colors = colors.subspan(4)) out = append_four(colors.data(), out);
  for (const Color color : colors) {
    *out++ = static_cast<char>(color.blue());
    *out++ = static_cast<char>(color.green());
    *out++ = static_cast<char>(color.red());
  }
}

void BmpWriter::write_block() {
  const std::size_t size = buffered_row_count_ * row_size_;
  written_row_count_ += buffered_row_count_;
  buffered_row_count_ = 0;
  const std::size_t rows_below = static_cast<std::size_t>(rows_) - written_row_count_;
  if (can_seek_ &&
      ::lseek(descriptor_, static_cast<off_t>(kHeaderSize + rows_below * row_size_), SEEK_SET) < 0)
    throw IoError("write", path_, errno);
  write_all(descriptor_, {block_.data() + block_.size() - size, size}, path_);
}

void BmpWriter::finish() {
  write_block();
  assert(written_row_count_ == static_cast<std::size_t>(rows_));
}

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
