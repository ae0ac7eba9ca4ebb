#pragma once

#include <cstring>
#include <vector>

#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// The visible contents of a picture.
struct Frame {
  std::vector<double> depths;
  std::vector<PixelTag> tags;

  void add(const VisibleRow& row) {
    depths.insert(depths.end(), row.depths.begin(), row.depths.end());
    tags.insert(tags.end(), row.tags.begin(), row.tags.end());
  }
  /// Compares bit by bit: 0 is not -0.
  friend bool operator==(const Frame& a, const Frame& b) {
    return a.tags == b.tags && a.depths.size() == b.depths.size() &&
           std::memcmp(a.depths.data(), b.depths.data(), a.depths.size() * sizeof(double)) == 0;
  }
};

template <typename Visible>
Frame frame_of(const Visible& visible) {
  Frame frame;
  visible.for_each_row([&](const VisibleRow& row) { frame.add(row); });
  return frame;
}

}  // namespace pipeline
