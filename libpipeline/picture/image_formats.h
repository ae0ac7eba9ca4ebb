#pragma once

#include <memory>
#include <string>

#include "libpipeline/picture/image_file.h"

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

/// A binary Netpbm image, a PPM (P6) or a PGM (P5), in blocks.
std::unique_ptr<ByteWriter> netpbm_writer(int descriptor, const std::string& path, PixelBytes pixels,
                                          int columns, int rows);

/// True if PNG files can be written: if the library was built with libpng.
bool can_write_png();
/// A PNG image, row by row; only if can_write_png().
std::unique_ptr<ByteWriter> png_writer(int descriptor, const std::string& path, PixelBytes pixels,
                                       int columns, int rows);

}  // namespace pipeline
