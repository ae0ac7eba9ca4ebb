#pragma once

#include <cstddef>
#include <span>
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

/// The count of the samples that adaptive sampling takes first, if there are more.
constexpr std::size_t kFirstSamples = 5;

/// The numbers of a pixel's `count` x `count` samples; those in the corner cells and the middle cell come
/// first.
std::vector<int> sample_order(int count);

/// The largest difference between two colors in a channel or in alpha; needs at least one color.
int largest_difference(std::span<const Color> colors);

}  // namespace pipeline
