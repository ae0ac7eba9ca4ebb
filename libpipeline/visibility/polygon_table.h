#pragma once

#include <cstdint>
#include <deque>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A polygon's number in its table. Polygons are numbered in the order of the stream.
using PolygonId = std::uint32_t;

/// The polygon table of the scan-line algorithm: every triangle that reaches the screen, in 88 bytes (72 more
/// where the text has more digits than doubles hold).
///
/// The textbook's entry has the plane equation, the shading information and the in-out flag. Here the plane
/// is its three vertices, from which the coverage rule makes the depth along a row, and the flag is kept only
/// for the polygons on the scanline (`RowPolygon`).
class PolygonTable {
 public:
  /// Adds the next triangle; its number is the count so far.
  void add(const ExactTriangle& triangle, PixelTag tag) {
    const bool has_low_parts = triangle.low_parts != nullptr && *triangle.low_parts != Triangle{};
    if (has_low_parts) low_parts_.push_back(*triangle.low_parts);
    const auto low_parts = static_cast<std::uint32_t>(has_low_parts ? low_parts_.size() : 0);
    polygons_.push_back({triangle.p_ndc, tag, low_parts, triangle.decimal_marks});
  }

  /// The triangle as it was added; refers to the table.
  [[nodiscard]] ExactTriangle triangle(PolygonId id) const {
    const Polygon& polygon = polygons_[id];
    return {polygon.p_ndc, polygon.low_parts == 0 ? nullptr : &low_parts_[polygon.low_parts - 1],
            polygon.decimal_marks};
  }
  [[nodiscard]] PixelTag tag(PolygonId id) const { return polygons_[id].tag; }
  [[nodiscard]] PolygonId size() const { return static_cast<PolygonId>(polygons_.size()); }

 private:
  struct Polygon {
    Triangle p_ndc;
    PixelTag tag;
    std::uint32_t low_parts;  // their index in low_parts_, counted from 1; 0: none
    std::uint16_t decimal_marks;
  };

  std::deque<Polygon> polygons_;
  std::deque<Triangle> low_parts_;
};

}  // namespace pipeline
