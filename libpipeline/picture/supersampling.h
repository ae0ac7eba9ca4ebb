#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The maximum number of samples along each side of a pixel: the exact coverage rule has room for these on
/// the largest screen.
constexpr int kMaxSamples = 16;

/// The screen whose pixels are the samples of `screen`: `count` x `count` per pixel, in a regular grid.
Viewport sample_screen(const Viewport& screen, int count);

/// Turns rows of samples into rows of pixels: each channel is the mean of the pixel's samples, rounded to the
/// nearest integer, halves up. Where the background is not opaque, so is the alpha, and each sample counts
/// for the other channels as much as its alpha: where it is invisible, they are the mean of the samples that
/// show a triangle.
class Downsampler {
 public:
  /// For rows of `columns` pixels with `count` x `count` samples each. Samples have the color of the
  /// background, or are opaque.
  Downsampler(int columns, int count, Color background = {});

  /// Takes the next row of samples; returns a row of pixels, valid until the next call, if that completes
  /// one.
  std::optional<std::span<const Color>> add(std::span<const Color> samples);

 private:
  void add_opaque(std::span<const Color> samples);
  [[nodiscard]] Color translucent_mean(std::size_t column) const;

  std::size_t count_;
  Color background_;
  std::size_t rows_taken_ = 0;
  std::vector<std::array<std::uint32_t, 3>> sums_;  // red, green, blue
  std::vector<std::uint32_t> opaque_counts_;        // empty where all samples are opaque
  std::vector<Color> row_;
};

}  // namespace pipeline
