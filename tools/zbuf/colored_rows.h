#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
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
              PictureOutputs& outputs)
      : store_(store), shader_(shader), outputs_(outputs), row_(first_row), pool_(shader ? thread_count : 1) {
    constexpr std::size_t kRowsOfThread = 8;
    waiting_.resize(kRowsOfThread * static_cast<std::size_t>(pool_.size()));
    colored_.resize(waiting_.size());
    if (shader) shader->set_workers(pool_.size());
  }

  /// Takes the next row.
  void add(const VisibleRow& seen) {
    std::span<const PixelTag> tags = seen.tags;
    if (!shader_) {
      colors_.resize(tags.size());
      store_.color(tags, colors_);
      return outputs_.write_colors(colors_);
    }
    const int row = row_ + static_cast<int>(count_);
    if (Wireframe* edges = store_.wireframe()) tags = edges->row(row, seen);
    waiting_[count_].tags.assign(tags.begin(), tags.end());
    if (++count_ == waiting_.size()) color();
  }
  /// Colors and writes the waiting rows.
  void finish() {
    color();
    color();
  }

 private:
  struct Row {
    std::vector<PixelTag> tags;
    std::vector<Color> colors;
  };
  void color() {
    pool_.start(static_cast<int>(count_), [this](int number, int worker) {
      Row& row = waiting_[static_cast<std::size_t>(number)];
      const auto colors = shader_->shade(row_ + number, row.tags, worker);
      row.colors.assign(colors.begin(), colors.end());
    });
    for (std::size_t i = 0; i < colored_count_; ++i) outputs_.write_colors(colored_[i].colors);
    pool_.finish();
    row_ += static_cast<int>(count_);
    waiting_.swap(colored_);
    colored_count_ = std::exchange(count_, 0);
  }

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
