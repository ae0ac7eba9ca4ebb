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

/// The mean of up to kMaxSamples^2 colors, each channel rounded to the nearest integer, halves up. Colors
/// that are not opaque must be equal. Alpha is averaged likewise; the other channels are weighted by alpha.
/// If all colors are invisible, the mean has their color.
class ColorMean {
 public:
  static constexpr std::uint32_t kEveryOther = 0xff00ff;
  /// The mean of `count` colors by sums of 16 bits each: of red and blue; of what alpha lacks to 255, and
  /// green. `background` is the color that need not be opaque.
  static Color of(std::uint32_t red_blue, std::uint32_t clear_green, std::uint32_t count, Color background) {
    const std::uint32_t red = red_blue >> 16, green = clear_green & 0xffff, blue = red_blue & 0xffff;
    if (background.is_opaque()) return {quotient(red, count), quotient(green, count), quotient(blue, count)};
    const std::uint32_t clear = clear_green >> 16, weight = 255 * count - clear;
    if (weight == 0) return background;
    const auto mean = [&](std::uint32_t sum, std::uint32_t of_background) {
      return quotient(255 * sum - clear * of_background, weight);
    };
    const Color color = {mean(red, background.red()), mean(green, background.green()),
                         mean(blue, background.blue())};
    return color.with_alpha(quotient(weight, count));
  }

  void add(Color color) {
    if (!color.is_opaque()) background_ = color;
    red_blue_ += color.rgb() & kEveryOther;
    clear_green_ += color.rgb() >> 8 & kEveryOther;
    ++count_;
  }
  /// The mean of at least one color.
  [[nodiscard]] Color mean() const { return of(red_blue_, clear_green_, count_, background_); }

 private:
  static std::uint8_t quotient(std::uint32_t sum, std::uint32_t divisor) {
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): a count is from 1 to 256
    return static_cast<std::uint8_t>((2 * sum + divisor) / (2 * divisor));
  }

  std::uint32_t red_blue_ = 0, clear_green_ = 0;
  std::uint32_t count_ = 0;
  Color background_;
};

/// Turns rows of samples into rows of pixels: each is the ColorMean of its samples.
class Downsampler {
 public:
  /// For rows of `columns` pixels with `count` x `count` samples each. A sample has the background's color or
  /// is opaque.
  Downsampler(int columns, int count, Color background = {})
      : count_(static_cast<std::size_t>(count)),
        background_(background),
        sums_(2 * count_ * static_cast<std::size_t>(columns)),
        row_(static_cast<std::size_t>(columns)) {}

  /// Takes the next row of samples; if it completes a row of pixels, returns that row, valid until the next
  /// call.
  std::optional<std::span<const Color>> add(std::span<const Color> samples);

 private:
  std::size_t count_;
  Color background_;
  std::size_t rows_taken_ = 0;
  std::vector<std::uint32_t> sums_;  // as in ColorMean, by column of samples: the first, then the second
  std::vector<Color> row_;
};

}  // namespace pipeline
