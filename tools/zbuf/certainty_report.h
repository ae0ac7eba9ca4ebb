#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/certainty/certain_pixels.h"
#include "libpipeline/stream/stage_reader.h"
#include "libpipeline/text/text_writer.h"
#include "tools/zbuf/triangle_store.h"

namespace pipeline {

/// The text of `--certify`: `certain N`, `uncertain M`, and a line `ROW COLUMN` for each uncertain pixel but
/// those beyond kMaxLines.
class CertaintyReport {
 public:
  static constexpr std::size_t kMaxLines = 100000;

  /// An InputError at the end of the header if the text has no bounds.
  CertaintyReport(const StageReader& reader, const Viewport& screen);

  /// Takes the next triangles.
  void add(const TriangleBatch& p_ndc) { pixels_.add(p_ndc); }
  /// Takes the tags of the triangles that the next row shows.
  void add_row(std::span<const PixelTag> tags, const TriangleStore& store);
  void write(TextWriter& text) const;

 private:
  CertainPixels pixels_;
  int row_;
  std::uint64_t pixel_count_ = 0, uncertain_count_ = 0;
  std::vector<std::pair<int, int>> uncertain_;
};

}  // namespace pipeline
