#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/unseen.h"

namespace pipeline {

/// The fate of a picture's triangles. Every triangle is counted once: as seen, as hidden, or by the reason
/// why it would show nowhere.
struct DrawingCounts {
  UnseenPlaces unseen;
  std::uint64_t triangles = 0;
  std::uint64_t seen = 0;              // triangles that own a pixel of the complete picture
  std::uint64_t hidden = 0;            // triangles that own none, but would if they were alone
  std::uint64_t outside_rows = 0;      // triangles that cover pixels, but none in the drawn rows
  std::uint64_t pixels_written = 0;    // pixels that show a triangle
  std::uint64_t fragments_tested = 0;  // the sum of the pixels that each triangle covers
  BoundingBox extent;                  // in NDC
};

/// Counts by drawing the triangles of a stream once more, pixel by pixel and in order, so that no count
/// depends on the visibility algorithm, its kernels or its threads. Keeps a depth and a number per pixel.
class DrawingCounter {
 public:
  DrawingCounter(const PixelRules& rules, const Viewport& screen) : screen_(screen), log_(rules, screen) {}

  void add(const TriangleBatch& p_ndc) {
    for (std::size_t i = 0; i < p_ndc.size(); ++i) add(exact_triangle(p_ndc, i));
  }

  /// The counts for the triangles so far.
  [[nodiscard]] DrawingCounts counts() const {
    DrawingCounts counts = counts_;
    std::vector<bool> is_seen(static_cast<std::size_t>(counts.triangles));
    log_.for_each_seen([&](std::uint64_t triangle) {
      ++counts.pixels_written;
      is_seen[static_cast<std::size_t>(triangle)] = true;
    });
    counts.seen = static_cast<std::uint64_t>(std::ranges::count(is_seen, true));
    counts.hidden -= counts.seen;
    return counts;
  }

 private:
  void add(const ExactTriangle& triangle) {
    FragmentDepths found;
    log_.add(triangle, counts_.triangles, [&](const Fragment& fragment) {
      ++counts_.fragments_tested;
      found.add(fragment.result);
    });
    const BoundingBox extent(triangle.p_ndc);
    counts_.extent.add(extent);
    ++counts_.triangles;
    if (found.visible)
      ++counts_.hidden;  // or seen, which only the complete picture shows
    else if (screen_.drawn_row_count() < screen_.rows && !found.before_front && !found.beyond_rear &&
             log_.is_covering(triangle))
      ++counts_.outside_rows;
    else
      counts_.unseen.add(unseen_place(triangle.p_ndc, extent, found, screen_), extent);
  }

  Viewport screen_;
  FragmentLog log_;  // numbers triangles by their index in the stream
  DrawingCounts counts_;
};

}  // namespace pipeline
