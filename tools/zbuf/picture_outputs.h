#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "libpipeline/numbers/ball.h"
#include "libpipeline/picture/image_file.h"
#include "libpipeline/picture/supersampling.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/text/output_file.h"
#include "libpipeline/text/text_writer.h"
#include "tools/rim/statistics.h"
#include "tools/rim/tool.h"
#include "tools/zbuf/picture_options.h"

namespace pipeline {

/// All requested outputs of a run: the image; the depths as text to standard output or a file, as an image
/// and as an array; the array of visible triangles; the text of `--seen`; the fragments and the statistics.
/// Closes them, and standard output, before the first gets its name.
class PictureOutputs {
 public:
  /// Opens the statistics.
  PictureOutputs(Tool& tool, const PictureOptions& chosen, Statistics& statistics);

  /// Opens a text that only one tool writes; null if `path` is empty. The path - can be that of a file.
  TextWriter* open_text(const std::string& path, bool may_be_stdout = true);
  /// Writes and closes the texts opened before the other outputs, and the statistics.
  void close_reports();
  /// Opens the image, the depths and the visible triangles. The image takes the colors of `sample_count` x
  /// `sample_count` samples per pixel. A background that is not opaque needs an image that can_hold_alpha.
  void open(const Viewport& screen, int sample_count, Color background);

  [[nodiscard]] bool wants_colors() const { return image_ != nullptr; }
  [[nodiscard]] bool wants_triangles() const { return triangles_ != nullptr; }
  // Each of these takes the next row, from the top.
  void write_colors(std::span<const Color> colors);
  void write_depths(std::span<const double> depths, std::span<const Ball> exact = {});
  /// Takes the numbers of triangles, if wanted.
  void write_triangles(std::span<const std::int64_t> numbers) { triangles_->write_row(numbers); }
  /// Writes all that is still buffered, closes and commits the files. If the run summarizes, reports the
  /// share of covered pixels.
  void finish(std::uint64_t covered_count);

 private:
  int opened(const std::string& path) { return files_.emplace_back(path).descriptor(); }

  Tool& tool_;
  const PictureOptions& chosen_;
  Statistics& statistics_;
  Viewport screen_;
  std::deque<OutputFile> files_;
  std::unique_ptr<ImageWriter> image_;
  std::optional<Downsampler> means_;
  std::deque<TextWriter> text_files_;
  std::vector<TextWriter*> texts_;  // standard output and files
  TextWriter* depths_ = nullptr;    // one of `texts_`, or null
  std::unique_ptr<RowWriter<double>> depth_image_;
  std::unique_ptr<RowWriter<double>> depth_array_;
  std::vector<double> array_row_;
  std::unique_ptr<RowWriter<std::int64_t>> triangles_;
};

}  // namespace pipeline
