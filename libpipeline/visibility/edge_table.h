#pragma once

#include <cassert>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

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

/// The edge table of the scan-line algorithm: for every scanline a bucket of the polygons whose edges begin
/// there, as a linked list like the textbook's; 4 bytes per scanline and 4 per polygon.
///
/// The textbook's entry is one edge with its x on the first scanline, its last scanline, dx per scanline and
/// polygon. Here an entry stands for the two edges of a polygon that cross a scanline, left and right: one
/// call of the coverage rule gives both ends, wherever one edge of a triangle ends and the next begins, and
/// the last row. There is no dx: see ActiveEdgeList.
class EdgeTable {
 public:
  explicit EdgeTable(int rows) : first_in_bucket_(static_cast<std::size_t>(rows), kNone) {}

  /// Adds the next polygon, whose edges begin on `first_row`, counted from the first row that is drawn; its
  /// number is the count so far.
  void add(int first_row) {
    PolygonId& first = first_in_bucket_[static_cast<std::size_t>(first_row)];
    const auto id = static_cast<PolygonId>(next_in_bucket_.size());
    assert(id != kNone);
    next_in_bucket_.push_back(first);
    first = id;
  }

  /// Calls `visit(polygon id)` for every polygon that begins on `row`, in no particular order.
  template <typename Visitor>
  void for_each_from(int row, Visitor&& visit) const {
    for (PolygonId id = first_in_bucket_[static_cast<std::size_t>(row)]; id != kNone;
         id = next_in_bucket_[id])
      visit(id);
  }

 private:
  static constexpr PolygonId kNone = std::numeric_limits<PolygonId>::max();

  std::vector<PolygonId> first_in_bucket_;
  std::deque<PolygonId> next_in_bucket_;
};

}  // namespace pipeline
