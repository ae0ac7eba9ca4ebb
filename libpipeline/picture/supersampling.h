#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The maximum number of samples along each side of a pixel; the exact coverage rule has room for them on the
/// largest screen.
constexpr int kMaxSamples = 16;

/// The screen whose pixels are the samples of `screen`: `count` x `count` per pixel, in a regular grid.
Viewport sample_screen(const Viewport& screen, int count);

/// The mean of colors, each channel rounded to the nearest integer, halves up. Colors that are not opaque
/// must be equal. Alpha is averaged likewise; the other channels are weighted by alpha. If all colors are
/// invisible, the mean has their color.
class ColorMean {
 public:
  void add(Color color) {
    if (!color.is_opaque()) {
      background_ = color;
      ++background_count_;
      return;
    }
    red_ += color.red();
    green_ += color.green();
    blue_ += color.blue();
    ++opaque_count_;
  }
  /// The mean of at least one color.
  [[nodiscard]] Color mean() const {
    if (background_count_ > 0) return translucent_mean();
    return {quotient(red_, opaque_count_), quotient(green_, opaque_count_), quotient(blue_, opaque_count_)};
  }

 private:
  static std::uint8_t quotient(std::uint32_t sum, std::uint32_t divisor) {
    return static_cast<std::uint8_t>((2 * sum + divisor) / (2 * divisor));
  }
  [[nodiscard]] Color translucent_mean() const {
    const std::uint32_t through = background_.alpha() * background_count_;
    const std::uint32_t weight = 255 * opaque_count_ + through;
    if (weight == 0) return background_;
    const auto mean = [&](std::uint32_t sum, std::uint32_t of_background) {
      return quotient(255 * sum + through * of_background, weight);
    };
    const Color color = {mean(red_, background_.red()), mean(green_, background_.green()),
                         mean(blue_, background_.blue())};
    return color.with_alpha(quotient(weight, opaque_count_ + background_count_));
  }

  std::uint32_t red_ = 0, green_ = 0, blue_ = 0;
  std::uint32_t opaque_count_ = 0;
  std::uint32_t background_count_ = 0;
  Color background_;
};

/// Turns rows of samples into rows of pixels: each is the ColorMean of its samples.
class Downsampler {
 public:
  /// For rows of `columns` pixels with `count` x `count` samples each. A sample has the background's color or
  /// is opaque.
  Downsampler(int columns, int count, Color background = {});

  /// Takes the next row of samples; if it completes a row of pixels, returns that row, valid until the next
  /// call.
  std::optional<std::span<const Color>> add(std::span<const Color> samples);

 private:
  std::size_t count_;
  std::size_t rows_taken_ = 0;
  // By column of samples, the sums of red and blue, 16 bits each, enough for 16 x 16 samples; then of green.
  std::vector<std::uint32_t> sums_;
  std::vector<ColorMean> means_;  // used instead of sums unless all samples are opaque
  std::vector<Color> row_;
};

}  // namespace pipeline
