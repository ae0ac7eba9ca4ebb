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
      background_(background),
      sums_(static_cast<std::size_t>(columns)),
      opaque_counts_(background.is_opaque() ? 0 : sums_.size()),
      row_(static_cast<std::size_t>(columns)) {}

/// Adds those samples that are opaque.
void Downsampler::add_opaque(std::span<const Color> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!samples[i].is_opaque()) continue;
    auto& [red, green, blue] = sums_[i / count_];
    red += samples[i].red();
    green += samples[i].green();
    blue += samples[i].blue();
    ++opaque_counts_[i / count_];
  }
}

// Z11
Color Downsampler::translucent_mean(std::size_t column) const {
  const auto all = static_cast<std::uint32_t>(count_ * count_);
  const std::uint32_t opaque = 255 * opaque_counts_[column];
  const std::uint32_t through = background_.alpha() * (all - opaque_counts_[column]);
  const std::uint32_t weight = opaque + through;
  if (weight == 0) return background_;
  const auto quotient = [](std::uint32_t sum, std::uint32_t divisor) {
    return static_cast<std::uint8_t>((2 * sum + divisor) / (2 * divisor));
  };
  const auto mean = [&](std::uint32_t sum, std::uint32_t of_background) {
    return quotient(255 * sum + through * of_background, weight);
  };
  const auto& [red, green, blue] = sums_[column];
  const Color color = {mean(red, background_.red()), mean(green, background_.green()),
                       mean(blue, background_.blue())};
  return color.with_alpha(quotient(weight, all));
}

std::optional<std::span<const Color>> Downsampler::add(std::span<const Color> samples) {
  assert(samples.size() == count_ * sums_.size());
  const bool is_translucent = !opaque_counts_.empty();
  if (is_translucent) add_opaque(samples);
  for (std::size_t i = 0; i < samples.size() && !is_translucent; ++i) {
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
    row_[column] = is_translucent ? translucent_mean(column) : Color(mean(red), mean(green), mean(blue));
    sums_[column] = {};
  }
  std::ranges::fill(opaque_counts_, 0u);
  return row_;
}

}  // namespace pipeline
