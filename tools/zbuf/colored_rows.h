#pragma once

#include <optional>
#include <vector>

#include "libpipeline/picture/surface_shader.h"
#include "libpipeline/scene/color.h"
#include "libpipeline/stream/thread_pool.h"
#include "tools/zbuf/picture_outputs.h"
#include "tools/zbuf/triangle_store.h"

namespace pipeline {

/// Colors the rows of an image, of pixels or of samples, by their tags. If surfaces are shaded, threads color
/// some rows while the rows before them are written.
class ColoredRows {
 public:
  /// Without a shader, the store has the colors.
  ColoredRows(TriangleStore& store, std::optional<SurfaceShader>& shader, int first_row, int thread_count,
              PictureOutputs& outputs);

  /// Takes the next row.
  void add(const VisibleRow& seen);
  /// Colors and writes the waiting rows.
  void finish();

 private:
  struct Row {
    std::vector<PixelTag> tags;
    std::vector<Color> colors;
  };
  void color();

  TriangleStore& store_;
  std::optional<SurfaceShader>& shader_;
  PictureOutputs& outputs_;
  std::vector<Color> colors_;  // without a shader
  int row_;                    // the first row not yet colored
  std::vector<Row> waiting_, colored_;
  std::size_t count_ = 0, colored_count_ = 0;  // of those rows
  ThreadPool pool_;
};

}  // namespace pipeline
