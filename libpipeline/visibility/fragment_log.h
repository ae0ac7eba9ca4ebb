#pragma once

#include <cstddef>
#include <cstdint>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/fragment.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// The depth test of the visibility algorithms, one fragment at a time and with the reason for its result.
/// `Depth` is a depth format.
template <typename Depth>
class FragmentTest {
 public:
  /// The fragment visible at a pixel so far.
  struct Seen {
    typename Depth::Stored depth;
    std::uint64_t triangle;
  };

  /// Where a triangle is visible, a fragment wins only if it is nearer by more than `epsilon`, at least 0.
  explicit FragmentTest(const Viewport& screen, double epsilon = 0)
      : format_(screen), front_(screen.front), rear_(format_.store(screen.rear)), epsilon_(epsilon) {}

  /// A pixel that shows no triangle.
  [[nodiscard]] Seen nothing() const { return {rear_, 0}; }

  /// Tests the next triangle's fragment of depth z at a pixel and updates `seen`.
  Fragment judge(Seen& seen, const Pixel& pixel, std::uint64_t triangle, double z) const {
    const typename Depth::Stored stored = format_.store(z);
    if (z < front_) return {pixel, triangle, z, DepthTestResult::before_front, 0};
    if (!(stored < rear_)) return {pixel, triangle, z, DepthTestResult::beyond_rear, 0};
    const double depth = format_.depth(stored);
    if (!(stored < seen.depth))
      return {pixel, triangle, depth, seen.depth < stored ? DepthTestResult::behind : DepthTestResult::equal,
              seen.triangle};
    if (seen.depth < rear_ && epsilon_ > 0 && !(format_.depth(seen.depth) - depth > epsilon_))
      return {pixel, triangle, depth, DepthTestResult::too_close, seen.triangle};
    seen = {stored, triangle};
    return {pixel, triangle, depth, DepthTestResult::kept, 0};
  }

 private:
  Depth format_;
  double front_;
  typename Depth::Stored rear_;
  double epsilon_;
};

/// Reports every fragment of the picture, triangle by triangle in the order of the stream and each from the
/// top left. A template of the coverage rule and the depth format in use; it keeps a depth and a number per
/// pixel.
template <typename Coverage, typename Depth>
class FragmentLog {
 public:
  explicit FragmentLog(const Viewport& screen, double epsilon = 0)
      : coverage_(screen),
        test_(screen, epsilon),
        seen_(screen.drawn_rows(), screen.columns, test_.nothing()) {}

  /// Calls `visit(fragment)` for every pixel the next triangle covers in the rows that are drawn.
  template <typename Visitor>
  void add(const ExactTriangle& p_ndc, std::uint64_t triangle, Visitor&& visit) {
    for_each_span(coverage_.rows(p_ndc), seen_.row_range(), [&](const Span& span) {
      for (int column = span.first_column; column <= span.last_column; ++column)
        visit(test_.judge(seen_.row(span.row)[static_cast<std::size_t>(column)], {column, span.row}, triangle,
                          span.depth(column)));
    });
  }

 private:
  Coverage coverage_;
  FragmentTest<Depth> test_;
  Raster<typename FragmentTest<Depth>::Seen> seen_;
};

/// The same for one pixel, with memory for that pixel alone.
template <typename Coverage, typename Depth>
class PixelProbe {
 public:
  /// `pixel` is on the screen.
  PixelProbe(const Viewport& screen, const Pixel& pixel, double epsilon = 0)
      : coverage_(screen), test_(screen, epsilon), pixel_(pixel), seen_(test_.nothing()) {}

  /// Calls `visit(fragment)` if the next triangle covers the pixel.
  template <typename Visitor>
  void add(const ExactTriangle& p_ndc, std::uint64_t triangle, Visitor&& visit) {
    for_each_span(coverage_.rows(p_ndc), RowRange{pixel_.row, pixel_.row + 1}, [&](const Span& span) {
      if (span.first_column <= pixel_.column && pixel_.column <= span.last_column)
        visit(test_.judge(seen_, pixel_, triangle, span.depth(pixel_.column)));
    });
  }

 private:
  Coverage coverage_;
  FragmentTest<Depth> test_;
  Pixel pixel_;
  typename FragmentTest<Depth>::Seen seen_;
};

}  // namespace pipeline
