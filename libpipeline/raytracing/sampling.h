#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "libpipeline/scene/color.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// Where the rays of a pixel go.
enum class Sampling {
  basic,     // one through its center
  regular,   // one through the center of each of N x N cells
  jittered,  // one through a random point of each cell
  adaptive   // as jittered, first through five cells; through the others only where those differ
};

/// True if samples are at random points of their cells.
constexpr bool is_random(Sampling sampling) {
  return sampling == Sampling::jittered || sampling == Sampling::adaptive;
}

/// The places of samples: pixels of a finer screen, so that the centers of its pixels are decided exactly by
/// the picture's own rule. A regular sample is the only pixel of its cell, a jittered one any
/// of 256 x 256.
///
/// Which one depends on the pixel and the sample's number alone, by a hash of them: no order and no thread
/// shows.
class SamplePlaces {
 public:
  /// The places in a cell, along each side, that a jittered sample may have.
  static constexpr int kJitterPlaces = 256;

  struct Place {
    int row, column;
    friend bool operator==(const Place&, const Place&) = default;
  };

  /// For `count` x `count` samples in each pixel of `pixels`, numbered row by row, at random points of their
  /// cells or in the middle.
  SamplePlaces(const Viewport& pixels, int count, bool are_random);

  /// The screen whose pixels are the places.
  [[nodiscard]] const Viewport& screen() const { return screen_; }
  [[nodiscard]] Place of(int row, int column, int sample) const;

 private:
  Viewport screen_;
  int count_;
  int places_;  // in a cell, along each side
};

/// The numbers of a pixel's samples in the order in which adaptive sampling takes them: the corner cells and
/// the one in the middle come first.
class SampleOrder {
 public:
  explicit SampleOrder(int count);

  [[nodiscard]] const std::vector<int>& samples() const { return samples_; }
  /// How many come first.
  [[nodiscard]] std::size_t first_count() const { return first_count_; }

 private:
  std::vector<int> samples_;
  std::size_t first_count_;
};

/// How far colors differ.
class ColorRange {
 public:
  void add(Color color) {
    const std::array<int, 4> channels = {color.red(), color.green(), color.blue(), color.alpha()};
    for (std::size_t i = 0; i < channels.size(); ++i) {
      least_[i] = std::min(least_[i], channels[i]);
      greatest_[i] = std::max(greatest_[i], channels[i]);
    }
  }
  /// The largest difference between two of them in a channel, or in alpha; at least one color.
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
