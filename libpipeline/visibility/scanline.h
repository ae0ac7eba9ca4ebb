#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/drawing.h"
#include "libpipeline/visibility/edge_table.h"
#include "libpipeline/visibility/row_sweep.h"

namespace pipeline {

/// The polygons that cross the current scanline, each with its rows by the coverage rule (`Rows`) and its
/// pixels on this scanline. A polygon keeps its slot until it is removed; another may then take the slot.
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

  /// Finds the pixels on `row` where the polygon at `slot` could be seen.
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

/// The visibility algorithm `scanline`: keeps the triangles and finds, row by row, the nearest at every
/// pixel. Needs memory for the triangles that reach the screen (88 bytes each, see PolygonTable), for the
/// triangles on one row, and for one row of pixels; never for the frame. The rows equal the z-buffer's to the
/// last bit: both take columns and depths from the same coverage rule, and compare depths as the same format
/// stores them.
///
/// Source: J. Foley, A. van Dam, S. Feiner, J. Hughes, "Computer Graphics: Principles and Practice", 2nd
/// edition, section 15.6 (and 3.6 for the edge table); D. Hearn, M. P. Baker, "Computer Graphics", 2nd
/// edition, section 13-5. The method is from C. Wylie, G. Romney, D. Evans, A. Erdahl, "Half-tone perspective
/// drawings by computer", 1967.
template <typename Coverage, typename Depth>
class Scanline final : public Drawing {
 public:
  /// Begins with every pixel at the rear limit, with the tag `background`.
  explicit Scanline(const Viewport& screen, PixelTag background = {})
      : screen_(screen),
        rows_(screen.drawn_rows()),
        background_(background),
        coverage_(screen),
        polygons_(screen.drawn_row_count()) {}

  /// Adds the next triangle.
  void draw(const ExactTriangle& triangle, PixelTag tag) {
    const auto rows = coverage_.rows(triangle);
    const int first_row = std::max(rows.first_row(), rows_.first);
    if (first_row > std::min(rows.last_row(), rows_.end - 1)) return;
    polygons_.add(triangle, tag, first_row - rows_.first);
  }

  TaggedBatch& next() override { return next_; }
  void draw_next() override {
    for (std::size_t i = 0; i < next_.batch.size(); ++i) draw(exact_triangle(next_.batch, i), next_.tags[i]);
  }
  void finish() override {}
  void for_each_drawn_row(const std::function<void(std::span<PixelTag>)>&) override {}
  void for_each_row(const std::function<void(const VisibleRow&)>& visit) const override {
    ActiveEdgeList edges;
    ActivePolygons<typename Coverage::Rows, Depth> active;
    RowSweep<Depth> sweep(screen_, background_);
    for (int row = rows_.first; row < rows_.end; ++row) {
      polygons_.for_each_from(row - rows_.first, [&](PolygonId id) {
        edges.add(active.add(id, polygons_.tag(id), coverage_.rows(polygons_.triangle(id))));
      });
      edges.for_each_polygon([&](std::uint32_t slot) { active.update(slot, row, sweep); });
      edges.sort([&](const ActiveEdge& edge) { return active.column_of(edge); });
      visit(sweep.sweep(edges.on_scanline(), active.on_row()));
      edges.for_each_polygon([&](std::uint32_t slot) { active.remove_if_ended(slot, row); });
      edges.remove_if([&](std::uint32_t slot) { return !active.has(slot); });
    }
  }

 private:
  Viewport screen_;
  RowRange rows_;  // the rows that are drawn
  PixelTag background_;
  Coverage coverage_;
  PolygonTable polygons_;
  TaggedBatch next_;
};

}  // namespace pipeline
