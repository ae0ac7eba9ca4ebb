#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "libpipeline/certainty/uncertain_triangle.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The depths of the triangles that may cover a pixel's center.
struct PixelDepths {
  /// True if the pixel certainly shows the triangle of this number, or the background.
  [[nodiscard]] bool certainly_shows(std::int64_t shown) const {
    return number == shown && second_nearest > farthest;
  }

  double farthest;      // the least upper bound on a depth of those that surely cover the center
  std::int64_t number;  // of that one
  // The two least lower bounds of those that may cover it.
  double nearest, second_nearest = std::numeric_limits<double>::infinity();
};

/// The pixels whose triangle, by rule `center`, is certain: one triangle surely covers the center, and no
/// other may be as near there, wherever the vertices are within the bounds of a projected text. The
/// background counts as a triangle that covers all centers at the rear limit.
class CertainPixels {
 public:
  static constexpr std::int64_t kBackground = -1;

  /// `projected` is the header's, a Frustum or an Orthographic, and `bounds` has both of its parts.
  CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// Takes the next triangles. Pieces stand for the triangle that they were cut from.
  void add(const TriangleBatch& p_ndc);
  /// The pixels of a drawn row.
  [[nodiscard]] std::span<const PixelDepths> row(int row) const {
    return std::span(pixels_).subspan(index_of(row), static_cast<std::size_t>(screen_.columns));
  }

 private:
  void add_row(const UncertainTriangle& triangle, int row, std::int64_t number);
  [[nodiscard]] std::size_t index_of(int row) const {
    return static_cast<std::size_t>(row - rows_.first) * static_cast<std::size_t>(screen_.columns);
  }

  UncertainView view_;
  Viewport screen_;
  RowRange rows_;                    // that are drawn
  std::vector<PixelDepths> pixels_;  // of the rows that are drawn
  std::shared_ptr<const ClipTriangle> last_whole_;
};

}  // namespace pipeline
