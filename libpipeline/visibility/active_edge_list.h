#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace pipeline {

/// Where on a scanline a polygon begins (left edge) or has just ended (right edge).
struct ActiveEdge {
  int column;          // the polygon's first, or the first after its last
  std::uint32_t slot;  // of the polygon among the active ones
  bool is_right;
};

/// The active edge list of the scan-line algorithm: the edges on the current scanline, sorted by column.
///
/// The textbook goes from one scanline to the next by x += dx. In doubles that puts 6816 of 1020230 span ends
/// (0.7%) into a column other than the exact one, for triangles whose vertices have two decimals on a screen
/// of 1000 x 1000 pixels (4028 if x is calculated anew instead of accumulated;
/// Scanline.IncrementalXWouldGiveOtherColumns counts them). So the coverage rule calculates the columns on
/// every row.
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
  /// order, new ones are sorted by themselves and merged in.
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
