#include "tools/zbuf/colored_rows.h"

#include <cstddef>
#include <utility>

namespace pipeline {

ColoredRows::ColoredRows(TriangleStore& store, std::optional<SurfaceShader>& shader, int first_row,
                         int thread_count, PictureOutputs& outputs)
    : store_(store), shader_(shader), outputs_(outputs), row_(first_row), pool_(shader ? thread_count : 1) {
  constexpr std::size_t kRowsOfThread = 8;
  waiting_.resize(kRowsOfThread * static_cast<std::size_t>(pool_.size()));
  colored_.resize(waiting_.size());
  if (shader) shader->set_workers(pool_.size());
}

void ColoredRows::add(const VisibleRow& seen) {
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

void ColoredRows::color() {
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

void ColoredRows::finish() {
  color();
  color();
}

}  // namespace pipeline
