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
      sums_(background.is_opaque() ? 2 * count_ * static_cast<std::size_t>(columns) : 0),
      means_(background.is_opaque() ? 0 : static_cast<std::size_t>(columns)),
      row_(static_cast<std::size_t>(columns)) {}

// Z11
std::optional<std::span<const Color>> Downsampler::add(std::span<const Color> samples) {
  assert(samples.size() == count_ * row_.size());
  const bool is_translucent = !means_.empty();
  const std::size_t greens = samples.size();  // after the sums of red and blue
  if (is_translucent) {
    for (std::size_t i = 0; i < samples.size(); ++i) means_[i / count_].add(samples[i]);
  } else {
    // Sums by columns of samples: compilers vectorize this.
    constexpr std::uint32_t kRedAndBlue = 0xff00ff;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      sums_[i] += samples[i].rgb() & kRedAndBlue;
      sums_[greens + i] += samples[i].green();
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
  // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): a count is from 1 to 16
  const auto mean = [&](std::uint32_t sum) { return static_cast<std::uint8_t>((2 * sum + all) / (2 * all)); };
  for (std::size_t column = 0; column < row_.size(); ++column) {
    std::uint32_t red_blue = 0, green = 0;
    for (std::size_t i = column * count_; i < (column + 1) * count_; ++i) {
      red_blue += sums_[i];
      green += sums_[greens + i];
    }
    row_[column] = Color(mean(red_blue >> 16), mean(green), mean(red_blue & 0xffff));
  }
  std::ranges::fill(sums_, 0);
  return row_;
}

}  // namespace pipeline
