#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/visibility/active_edge_list.h"
#include "libpipeline/visibility/polygon_table.h"
#include "libpipeline/visibility/row_sweep.h"

namespace pipeline {

/// The polygons that cross the current scanline, with what the coverage rule made of them (`Rows`) and their
/// pixels there. A polygon keeps its place while it is here; the places of polygons that are gone are used
/// again.
template <typename Rows, typename Depth>
class ActivePolygons {
 public:
  /// Adds polygon `id`; returns its place.
  std::uint32_t add(PolygonId id, Color color, Rows&& rows) {
    if (free_places_.empty()) {
      free_places_.push_back(static_cast<std::uint32_t>(polygons_.size()));
      polygons_.emplace_back();
      on_row_.emplace_back();
    }
    const std::uint32_t place = free_places_.back();
    free_places_.pop_back();
    polygons_[place].rows.emplace(std::move(rows));
    polygons_[place].id = id;
    polygons_[place].color = color;
    return place;
  }

  /// Finds the pixels of the polygon at `place` on `row` that could be seen.
  void update(std::uint32_t place, int row, const RowSweep<Depth>& sweep) {
    const Polygon& polygon = polygons_[place];
    const auto span = polygon.rows->span(row);
    on_row_[place] = span ? sweep.polygon(*span, polygon.id, polygon.color) : RowPolygon<Depth>();
  }

  /// The column of an edge on the row of the last update.
  [[nodiscard]] int column_of(const ActiveEdge& edge) const {
    const RowPolygon<Depth>& polygon = on_row_[edge.place];
    if (polygon.is_empty()) return ActiveEdgeList::kNowhere;
    return edge.is_right ? polygon.last_column + 1 : polygon.first_column;
  }
  [[nodiscard]] std::span<RowPolygon<Depth>> on_row() { return on_row_; }

  /// Removes the polygon at `place` if `row` is its last.
  void remove_if_ended(std::uint32_t place, int row) {
    if (row < polygons_[place].rows->last_row()) return;
    polygons_[place].rows.reset();
    free_places_.push_back(place);
  }
  [[nodiscard]] bool has(std::uint32_t place) const { return polygons_[place].rows.has_value(); }

 private:
  struct Polygon {
    std::optional<Rows> rows;
    PolygonId id = 0;
    Color color;
  };

  std::vector<Polygon> polygons_;
  std::vector<RowPolygon<Depth>> on_row_;  // at the same places
  std::vector<std::uint32_t> free_places_;
};

}  // namespace pipeline
