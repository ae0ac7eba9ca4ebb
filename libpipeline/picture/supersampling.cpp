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

Downsampler::Downsampler(int columns, int count, Color background)
    : count_(static_cast<std::size_t>(count)),
      sums_(static_cast<std::size_t>(columns)),
      means_(background.is_opaque() ? 0 : sums_.size()),
      row_(static_cast<std::size_t>(columns)) {}

// Z11
std::optional<std::span<const Color>> Downsampler::add(std::span<const Color> samples) {
  assert(samples.size() == count_ * sums_.size());
  const bool is_translucent = !means_.empty();
  if (is_translucent) {
    for (std::size_t i = 0; i < samples.size(); ++i) means_[i / count_].add(samples[i]);
  } else {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      auto& [red, green, blue] = sums_[i / count_];
      red += samples[i].red();
      green += samples[i].green();
      blue += samples[i].blue();
    }
  }
  if (++rows_taken_ < count_) return std::nullopt;
  rows_taken_ = 0;
  if (is_translucent) {
    std::ranges::transform(means_, row_.begin(), &ColorMean::mean);
    std::ranges::fill(means_, ColorMean());
    return row_;
  }
  const auto all = static_cast<std::uint32_t>(count_ * count_);
  const auto mean = [&](std::uint32_t sum) { return static_cast<std::uint8_t>((2 * sum + all) / (2 * all)); };
  for (std::size_t column = 0; column < row_.size(); ++column) {
    const auto& [red, green, blue] = sums_[column];
    row_[column] = Color(mean(red), mean(green), mean(blue));
    sums_[column] = {};
  }
  return row_;
}

}  // namespace pipeline
