#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/visibility/active_edge_list.h"
#include "libpipeline/visibility/polygon_table.h"
#include "libpipeline/visibility/row_sweep.h"

namespace pipeline {

/// The polygons that cross the current scanline, each with its rows by the coverage rule (`Rows`) and its
/// pixels on this one. A polygon keeps its slot until it is removed; then the slot is free for another.
template <typename Rows, typename Depth>
class ActivePolygons {
 public:
  /// Adds polygon `id`; returns its slot.
  std::uint32_t add(PolygonId id, PixelTag tag, Rows&& rows) {
    if (free_slots_.empty()) {
      free_slots_.push_back(static_cast<std::uint32_t>(polygons_.size()));
      polygons_.emplace_back();
      on_row_.emplace_back();
    }
    const std::uint32_t slot = free_slots_.back();
    free_slots_.pop_back();
    polygons_[slot].rows.emplace(std::move(rows));
    polygons_[slot].id = id;
    polygons_[slot].tag = tag;
    return slot;
  }

  /// Finds the pixels of the polygon at `slot` on `row` that could be seen.
  void update(std::uint32_t slot, int row, const RowSweep<Depth>& sweep) {
    const Polygon& polygon = polygons_[slot];
    const auto span = polygon.rows->span(row);
    on_row_[slot] = span ? sweep.polygon(*span, polygon.id, polygon.tag) : RowPolygon<Depth>();
  }

  /// The column of an edge on the row of the last update.
  [[nodiscard]] int column_of(const ActiveEdge& edge) const {
    const RowPolygon<Depth>& polygon = on_row_[edge.slot];
    if (polygon.is_empty()) return ActiveEdgeList::kNowhere;
    return edge.is_right ? polygon.last_column + 1 : polygon.first_column;
  }
  [[nodiscard]] std::span<RowPolygon<Depth>> on_row() { return on_row_; }

  /// Removes the polygon at `slot` if `row` is its last.
  void remove_if_ended(std::uint32_t slot, int row) {
    if (row < polygons_[slot].rows->last_row()) return;
    polygons_[slot].rows.reset();
    free_slots_.push_back(slot);
  }
  [[nodiscard]] bool has(std::uint32_t slot) const { return polygons_[slot].rows.has_value(); }

 private:
  struct Polygon {
    std::optional<Rows> rows;
    PolygonId id = 0;
    PixelTag tag = 0;
  };

  std::vector<Polygon> polygons_;
  std::vector<RowPolygon<Depth>> on_row_;  // at the same slots
  std::vector<std::uint32_t> free_slots_;
};

}  // namespace pipeline
