#include "libpipeline/picture/supersampling.h"

#include <cassert>

namespace pipeline {

Viewport sample_screen(const Viewport& screen, int count) {
  assert(count >= 1 && count <= kMaxSamples);
  Viewport samples = screen;
  samples.columns *= count;
  samples.rows *= count;
  samples.drawn = {count * screen.drawn_rows().first, count * screen.drawn_rows().end};
  return samples;
}

Downsampler::Downsampler(int columns, int count)
    : count_(static_cast<std::size_t>(count)),
      sums_(static_cast<std::size_t>(columns)),
      row_(static_cast<std::size_t>(columns)) {}

std::optional<std::span<const Color>> Downsampler::add(std::span<const Color> samples) {
  assert(samples.size() == count_ * sums_.size());
  for (std::size_t i = 0; i < samples.size(); ++i) {
    auto& [red, green, blue] = sums_[i / count_];
    red += samples[i].red();
    green += samples[i].green();
    blue += samples[i].blue();
  }
  if (++rows_taken_ < count_) return std::nullopt;
  rows_taken_ = 0;
  const auto all = static_cast<std::uint32_t>(count_ * count_);
  const auto mean = [&](std::uint32_t sum) { return static_cast<std::uint8_t>((2 * sum + all) / (2 * all)); };
  for (std::size_t column = 0; column < row_.size(); ++column) {
    const auto& [red, green, blue] = sums_[column];
    row_[column] = {mean(red), mean(green), mean(blue)};
    sums_[column] = {};
  }
  return row_;
}

}  // namespace pipeline
