#include "libpipeline/picture/supersampling.h"

#include <algorithm>
#include <cassert>

namespace pipeline {

// Z12
Viewport sample_screen(const Viewport& screen, int count) {
  assert(count >= 1 && count <= kMaxSamples);
  Viewport samples = screen;
  samples.columns *= count;
  samples.rows *= count;
  samples.drawn = {count * screen.drawn_rows().first, count * screen.drawn_rows().end};
  return samples;
}

// Z11
std::optional<std::span<const Color>> Downsampler::add(std::span<const Color> samples) {
  assert(samples.size() == count_ * row_.size());
  const std::size_t size = samples.size();
  for (std::size_t i = 0; i < size; ++i) {  // compilers vectorize this
    sums_[i] += samples[i].rgb() & ColorMean::kEveryOther;
    sums_[size + i] += samples[i].rgb() >> 8 & ColorMean::kEveryOther;
  }
  if (++rows_taken_ < count_) return std::nullopt;
  rows_taken_ = 0;
  const auto all = static_cast<std::uint32_t>(count_ * count_);
  const Color background = background_;  // a copy: colors that are written do not change it
  for (std::size_t column = 0; column < row_.size(); ++column) {
    std::uint32_t red_blue = 0, clear_green = 0;
    for (std::size_t i = column * count_; i < (column + 1) * count_; ++i) {
      red_blue += sums_[i];
      clear_green += sums_[size + i];
    }
    row_[column] = ColorMean::of(red_blue, clear_green, all, background);
  }
  std::ranges::fill(sums_, 0);
  return row_;
}

}  // namespace pipeline
