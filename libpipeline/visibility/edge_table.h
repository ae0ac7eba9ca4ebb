#pragma once

#include <cassert>
#include <cstdint>
#include <deque>
#include <limits>
#include <span>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/numbers/vec.h"

namespace pipeline {

/// A polygon's number in its table. Polygons are numbered in the order of the stream.
using PolygonId = std::uint32_t;

/// The polygon table and the edge table of the scan-line algorithm: every triangle that reaches the screen,
/// in 88 bytes (and 72 more if the text has more digits than doubles hold), and for every scanline a bucket
/// of the polygons whose edges begin there, as a linked list like the textbook's. The textbook's polygon has
/// the plane equation, the shading information and the in-out flag. Here, three vertices stand for the plane:
/// the coverage rule calculates the depth along a row from them. Only polygons on the scanline have a flag
/// (`RowPolygon`). The textbook's edge has its x on the first scanline, its last scanline, dx per scanline
/// and polygon. Here, an entry stands for the two edges of a polygon that cross a scanline, left and right:
/// one call of the coverage rule finds both ends, even where one edge of a triangle ends and the next begins;
/// it also knows the last row. There is no dx: see ActiveEdgeList.
class PolygonTable {
 public:
  explicit PolygonTable(int rows) : first_in_bucket_(static_cast<std::size_t>(rows), kNone) {}

  /// Adds the next triangle, whose edges begin on `first_row`, counted from the first drawn row; its number
  /// is the count so far.
  void add(const ExactTriangle& triangle, PixelTag tag, int first_row) {
    const bool has_low_parts = triangle.low_parts != nullptr && *triangle.low_parts != Triangle{};
    if (has_low_parts) low_parts_.push_back(*triangle.low_parts);
    const auto low_parts = static_cast<std::uint32_t>(has_low_parts ? low_parts_.size() : 0);
    PolygonId& first = first_in_bucket_[static_cast<std::size_t>(first_row)];
    assert(polygons_.size() < kNone);
    polygons_.push_back({triangle.p_ndc, tag, low_parts, first, triangle.decimal_marks});
    first = static_cast<PolygonId>(polygons_.size() - 1);
  }

  /// The triangle as added; refers to the table.
  [[nodiscard]] ExactTriangle triangle(PolygonId id) const {
    const Polygon& polygon = polygons_[id];
    return {polygon.p_ndc, polygon.low_parts == 0 ? nullptr : &low_parts_[polygon.low_parts - 1],
            polygon.decimal_marks};
  }
  [[nodiscard]] PixelTag tag(PolygonId id) const { return polygons_[id].tag; }

  /// Calls `visit(polygon id)` for every polygon that begins on `row`, in no particular order.
  template <typename Visitor>
  void for_each_from(int row, Visitor&& visit) const {
    PolygonId id = first_in_bucket_[static_cast<std::size_t>(row)];
    for (; id != kNone; id = polygons_[id].next_in_bucket) visit(id);
  }

 private:
  static constexpr PolygonId kNone = std::numeric_limits<PolygonId>::max();
  struct Polygon {
    Triangle p_ndc;
    PixelTag tag;
    std::uint32_t low_parts;  // an index of low_parts_, counted from 1; 0: none
    PolygonId next_in_bucket;
    std::uint16_t decimal_marks;
  };

  std::vector<PolygonId> first_in_bucket_;
  std::deque<Polygon> polygons_;
  std::deque<Triangle> low_parts_;
};

/// The column of a scanline where a polygon begins (left edge) or has just ended (right edge).
struct ActiveEdge {
  int column;          // the polygon's first column, or the first after its last
  std::uint32_t slot;  // of the polygon among the active ones
  bool is_right;
};

/// The active edge list of the scan-line algorithm: the edges on the current scanline, sorted by column. The
/// textbook goes from one scanline to the next by x += dx. In doubles, this puts 6816 of 1020230 span ends
/// (0.7%) into a wrong column, for triangles whose vertices have two decimals on a screen of 1000 x 1000
/// pixels (4028 if x is calculated anew instead of accumulated; Scanline.IncrementalXWouldGiveOtherColumns
/// counts them). So the coverage rule calculates the columns on every row.
class ActiveEdgeList {
 public:
  /// The column of an edge whose polygon has no pixel on this scanline; such edges are sorted to the end.
  static constexpr int kNowhere = std::numeric_limits<int>::max();

  /// Adds the two edges of the polygon at `slot`. `sort` sets their columns.
  void add(std::uint32_t slot) {
    edges_.push_back({kNowhere, slot, false});
    edges_.push_back({kNowhere, slot, true});
  }

  /// Removes both edges of every polygon for which has_ended(slot).
  template <typename Predicate>
  void remove_if(Predicate&& has_ended) {
    std::erase_if(edges_, [&](const ActiveEdge& edge) { return has_ended(edge.slot); });
    sorted_count_ = edges_.size();
  }

  /// Calls `visit(slot)` once for every polygon.
  template <typename Visitor>
  void for_each_polygon(Visitor&& visit) const {
    for (const ActiveEdge& edge : edges_)
      if (!edge.is_right) visit(edge.slot);
  }

  /// Sets every edge's column to column_of(edge) and sorts: edges from the previous scanline are nearly in
  /// order; new edges are sorted separately and merged in.
  template <typename ColumnOf>
  void sort(ColumnOf&& column_of) {
    for (ActiveEdge& edge : edges_) edge.column = column_of(edge);
    sort_by_column();
  }

  /// The edges of the polygons that have pixels on the scanline.
  [[nodiscard]] std::span<const ActiveEdge> on_scanline() const;

 private:
  void sort_by_column();

  std::vector<ActiveEdge> edges_;
  std::size_t sorted_count_ = 0;  // the edges from the previous scanline; new ones come after them
};

}  // namespace pipeline
