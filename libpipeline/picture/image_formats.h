#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/text/text_writer.h"

namespace pipeline {

// The formats of images, each in a source of its own.

/// An InputError names `path` if the image does not fit into a BMP, which counts its bytes in 32 bits.
void check_bmp_size(const std::string& path, int columns, int rows);

/// A Windows bitmap: 24 bits per pixel, rows from the bottom. Blocks of 64 KiB are written at their positions
/// in the file, so that few rows are in memory; if the file cannot seek (a pipe), the whole image is. Throws
/// like check_bmp_size.
std::unique_ptr<ImageWriter> bmp_writer(int descriptor, const std::string& path, int columns, int rows);

/// The bytes of a pixel: red, green and blue; these and alpha (PNG only); or 16 bits of gray, high byte
/// first.
enum class PixelBytes { rgb8, rgba8, gray16 };
using ByteWriter = RowWriter<unsigned char>;

/// Writes a header, and the pixels as they are in memory.
template <typename Pixel>
class PlainWriter final : public RowWriter<Pixel> {
 public:
  PlainWriter(int descriptor, const std::string& path, const std::string& header)
      : descriptor_(descriptor), path_(path), buffered_(header) {}

  void write_row(std::span<const Pixel> pixels) override {
    buffered_.append(reinterpret_cast<const char*>(pixels.data()), pixels.size_bytes());
    if (buffered_.size() >= std::size_t{1} << 16) finish();
  }
  void finish() override {
    write_all(descriptor_, buffered_, path_);
    buffered_.clear();
  }

 private:
  int descriptor_;
  std::string path_, buffered_;
};

/// Writes pixels by a writer of bytes. `convert(pixel, out)` writes a pixel's bytes, at most four, to `out`
/// and returns their end.
template <typename Pixel, typename Convert>
class ConvertingWriter final : public RowWriter<Pixel> {
 public:
  ConvertingWriter(std::unique_ptr<ByteWriter> rows, Convert convert)
      : rows_(std::move(rows)), convert_(std::move(convert)) {}

  void write_row(std::span<const Pixel> pixels) override {
    const Convert convert = convert_;  // a copy: bytes that are written do not change it
    bytes_.resize(4 * pixels.size());
    unsigned char* out = bytes_.data();
    for (const Pixel& pixel : pixels) out = convert(pixel, out);
    rows_->write_row({bytes_.data(), out});
  }
  void finish() override { rows_->finish(); }

 private:
  std::unique_ptr<ByteWriter> rows_;
  Convert convert_;
  std::vector<unsigned char> bytes_;
};

/// A binary Netpbm image, a PPM (P6) or a PGM (P5), in blocks.
std::unique_ptr<ByteWriter> netpbm_writer(int descriptor, const std::string& path, PixelBytes pixels,
                                          int columns, int rows);

/// True if PNG files can be written: if the library was built with libpng.
bool can_write_png();
/// A PNG image, row by row; only if can_write_png().
std::unique_ptr<ByteWriter> png_writer(int descriptor, const std::string& path, PixelBytes pixels,
                                       int columns, int rows);

}  // namespace pipeline
