#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "libpipeline/certainty/uncertain_triangle.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// The pixels whose triangle, by the rule `center`, is certain: wherever the vertices lie within the bounds
/// of a projected text, one triangle covers the center, and no other is as near there. The background counts
/// as a triangle that covers all centers at the rear limit.
class CertainPixels {
 public:
  static constexpr std::int64_t kBackground = -1;
  static constexpr std::size_t kMaxLines = 100000;  // in the report

  /// `projected` comes from the header, a Frustum or an Orthographic; `bounds` has both of its parts.
  CertainPixels(const Viewport& screen, const Bounds& bounds, const Projection& projected);

  /// Takes the next triangles. Pieces stand for the triangle that they were cut from.
  void add(const TriangleBatch& p_ndc);
  /// Takes the numbers of the triangles that the next drawn row shows.
  void add_row(std::span<const std::int64_t> shown);
  /// `certain N`, `uncertain M`, and a line `ROW COLUMN` for each of the first kMaxLines uncertain pixels.
  [[nodiscard]] std::string report() const;

 private:
  /// The depths of the triangles that may cover a pixel's center.
  struct Pixel {
    double farthest;      // bounds the nearest depth of triangles that surely cover it
    std::int64_t number;  // of the nearest triangle that surely covers it
    // The two smallest lower bounds on depths of triangles that may cover it.
    double nearest, second_nearest = std::numeric_limits<double>::infinity();
  };

  [[nodiscard]] std::span<Pixel> pixels_of(int row);
  void add_row(const UncertainTriangle& triangle, int row, std::int64_t number);

  UncertainView view_;
  Viewport screen_;
  int next_row_;
  std::vector<Pixel> pixels_;  // of the rows that are drawn
  std::shared_ptr<const ClipTriangle> last_whole_;
  std::size_t uncertain_count_ = 0;
  std::vector<std::pair<int, int>> uncertain_;  // rows and columns of the first ones
};

}  // namespace pipeline
