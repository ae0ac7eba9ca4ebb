#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The points of a pixel through which its rays go.
enum class Sampling {
  basic,     // its center
  regular,   // the center of each of N x N cells
  jittered,  // a random point of each cell
  adaptive   // as jittered, first in five cells; in the others only if those differ
};

/// True if samples are at random points of their cells.
constexpr bool is_random(Sampling sampling) {
  return sampling == Sampling::jittered || sampling == Sampling::adaptive;
}

/// The places of samples: pixels of a finer screen, so that the picture's own rule decides their centers
/// exactly. A regular sample is the only fine pixel of its cell, a jittered one any of 256 x 256.
/// Which one is a hash of the pixel and the sample's number alone: order and threads have no influence.
class SamplePlaces {
 public:
  /// The count of places for a jittered sample along each side of a cell.
  static constexpr int kJitterPlaces = 256;

  struct Place {
    int row, column;
    friend bool operator==(const Place&, const Place&) = default;
  };

  /// For `count` x `count` samples, numbered row by row, in each pixel of `pixels`, at random points of their
  /// cells or in the middle.
  SamplePlaces(const Viewport& pixels, int count, bool are_random);

  /// The screen whose pixels are the places.
  [[nodiscard]] const Viewport& screen() const { return screen_; }
  [[nodiscard]] Place of(int row, int column, int sample) const;

 private:
  Viewport screen_;
  int count_;
  int places_;  // along each side of a cell
};

/// The numbers of a pixel's samples in the order of adaptive sampling: the corner cells and the middle cell
/// come first.
class SampleOrder {
 public:
  explicit SampleOrder(int count);

  [[nodiscard]] const std::vector<int>& samples() const { return samples_; }
  /// The count of samples that come first.
  [[nodiscard]] std::size_t first_count() const { return first_count_; }

 private:
  std::vector<int> samples_;
  std::size_t first_count_;
};

/// The spread of colors.
class ColorRange {
 public:
  void add(Color color) {
    const std::array<int, 4> channels = {color.red(), color.green(), color.blue(), color.alpha()};
    for (std::size_t i = 0; i < channels.size(); ++i) {
      least_[i] = std::min(least_[i], channels[i]);
      greatest_[i] = std::max(greatest_[i], channels[i]);
    }
  }
  /// The largest difference between two colors in a channel or in alpha; needs at least one color.
  [[nodiscard]] int range() const {
    int range = 0;
    for (std::size_t i = 0; i < least_.size(); ++i) range = std::max(range, greatest_[i] - least_[i]);
    return range;
  }

 private:
  std::array<int, 4> least_ = {255, 255, 255, 255};
  std::array<int, 4> greatest_{};
};

}  // namespace pipeline
