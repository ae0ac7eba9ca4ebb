#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/scene/color.h"

namespace pipeline {

/// An InputError naming `path` if the image does not fit into a BMP, which counts its bytes in 32 bits.
void check_bmp_size(const std::string& path, int columns, int rows);

/// Writes a Windows bitmap: 24 bits per pixel, rows from the bottom. Blocks of 64 KiB are written at their
/// positions in the file, so that few rows are in memory; where the file cannot seek (a pipe), the whole
/// image is kept in memory.
class BmpWriter final : public ImageWriter {
 public:
  /// Throws like check_bmp_size.
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
  // Rows not yet written, in the order of the file: filled from its end.
  std::vector<char> block_;
  std::size_t buffered_row_count_ = 0;
  std::size_t written_row_count_ = 0;
};

}  // namespace pipeline
