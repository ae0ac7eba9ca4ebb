#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "libpipeline/picture/image_file.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/output_file.h"

namespace pipeline {

/// The image, if one is requested: takes the colors of its pixels, or of their samples, row by row.
class ImageRows {
 public:
  /// An empty path means no image. A background that is not opaque needs a file that can_hold_alpha.
  ImageRows(const std::string& path, const Viewport& screen, int sample_count, Color background = {});

  [[nodiscard]] bool is_wanted() const { return pixels_ != nullptr; }
  void write_row(std::span<const Color> colors);
  void close();
  void commit();

 private:
  std::optional<OutputFile> file_;
  std::unique_ptr<ImageWriter> pixels_;
  std::optional<Downsampler> means_;
};

/// "out.bmp: 400 x 300, 61 % covered". Only an empty picture has 0 %, only a full one 100 %.
std::string summary(const std::string& image_path, const Viewport& screen, std::uint64_t covered_count);

}  // namespace pipeline
