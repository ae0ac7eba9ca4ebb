#pragma once

#include <cassert>
#include <deque>
#include <limits>
#include <vector>

#include "libpipeline/visibility/polygon_table.h"

namespace pipeline {

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
