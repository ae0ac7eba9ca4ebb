#include "tools/zbuf/colored_rows.h"

namespace pipeline {
namespace {

constexpr int kRowsOfThread = 8;

}  // namespace

ColoredRows::ColoredRows(TriangleStore& store, std::optional<SurfaceShader>& shader, AllEdges* edges,
                         int first_row, int thread_count, PictureOutputs& outputs)
    : store_(store),
      shader_(shader),
      edges_(edges),
      outputs_(outputs),
      row_(first_row),
      pool_(shader ? thread_count : 1) {
  waiting_.resize(static_cast<std::size_t>(kRowsOfThread * pool_.size()));
  if (shader) shader->set_workers(pool_.size());
}

void ColoredRows::add(std::span<const PixelTag> tags) {
  if (!shader_) {
    colors_.resize(tags.size());
    store_.color(tags, colors_);
    return outputs_.write_colors(colors_);
  }
  const int row = row_ + static_cast<int>(count_);
  if (edges_ != nullptr) tags = edges_->row(row, *shader_->setup().wireframe);
  waiting_[count_].tags.assign(tags.begin(), tags.end());
  if (++count_ == waiting_.size()) finish();
}

void ColoredRows::finish() {
  if (count_ == 0) return;
  pool_.start(static_cast<int>(count_), [this](int number, int worker) {
    Row& row = waiting_[static_cast<std::size_t>(number)];
    const auto colors = shader_->shade(row_ + number, row.tags, worker);
    row.colors.assign(colors.begin(), colors.end());
  });
  pool_.finish();
  for (std::size_t i = 0; i < count_; ++i) outputs_.write_colors(waiting_[i].colors);
  row_ += static_cast<int>(count_);
  count_ = 0;
}

}  // namespace pipeline
