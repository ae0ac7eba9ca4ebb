#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "libpipeline/coverage/span.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/visibility/depth_format.h"
#include "libpipeline/visibility/edge_table.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// The part of a polygon's span between the depth limits, visible if the polygon were alone: neighboring
/// pixels of one scanline.
template <typename Depth>
struct RowPolygon {
  /// The index_in_list of a polygon whose in-out flag is "out": the sweep is not between its edges.
  static constexpr std::uint32_t kOut = std::numeric_limits<std::uint32_t>::max();

  [[nodiscard]] bool is_empty() const { return first_column > last_column; }

  SpanDepth depth = {};
  int first_column = 0;
  int last_column = -1;
  typename Depth::Stored nearest = {};  // the least of the stored depths of its pixels
  typename Depth::Stored farthest = {};
  double size = 0;  // bounds the depths along the row, and their terms
  // At least twice a depth's deviation from the exact linear function; 0 if depths are exact.
  double error = 0;
  PolygonId id = 0;
  PixelTag tag = 0;
  std::uint32_t index_in_list = kOut;  // in the active polygon list
};

/// The scan-line algorithm on one scanline: goes from edge to edge, keeps the list of active polygons (whose
/// edges enclose it), and assigns the pixels between neighboring edges to the nearest. The textbook compares
/// depths once for every interval between two edges, at its left end, and is wrong where polygons
/// interpenetrate. Here, the visible polygon of an interval is compared with the others at both ends. Along a
/// row, depths are linear functions, so if the difference of two exceeds the rounding errors at both ends, it
/// has the same sign at every pixel between. If not, the interval is split at the crossing, and the pixels
/// that rounding decides are compared one by one, as by the z-buffer: the smaller stored depth wins, or the
/// earlier polygon if both are equal. A polygon stays visible as long as it is surely nearest, even across
/// edges of polygons behind it, and a new polygon is compared only with it (depth coherence). So a scanline
/// takes time for its edges and its visible pixels, not for every pixel of every layer.
template <typename Depth>
class RowSweep {
 public:
  RowSweep(const Viewport& screen, PixelTag background);

  /// The pixels of `span` between the depth limits, with the range and precision of their depths.
  [[nodiscard]] RowPolygon<Depth> polygon(const Span& span, PolygonId id, PixelTag tag) const;

  /// The visible row, valid until the next call. `edges`, sorted by column, has the two edges of every
  /// polygon that is not empty, each with its slot in `polygons`.
  VisibleRow sweep(std::span<const ActiveEdge> edges, std::span<RowPolygon<Depth>> polygons);

 private:
  using Polygon = RowPolygon<Depth>;
  struct ActivePolygon {
    typename Depth::Stored nearest;
    std::uint32_t slot;
  };

  [[nodiscard]] bool is_before_rear(double z) const { return is_nearer(format_.store(z), rear_); }
  [[nodiscard]] Polygon& active(std::size_t i) { return polygons_[active_[i].slot]; }
  void clear_pixels();
  void enter(std::uint32_t slot, int column);
  void leave(Polygon& polygon);
  void compare_with_visible(Polygon& polygon, int column);
  void choose_visible(int column);
  [[nodiscard]] Polygon* nearest_at(int column);
  [[nodiscard]] int end_of_nearer(const Polygon& front, const Polygon& back, int column, int end) const;
  void give(int column, int end);
  void paint(const Polygon& polygon, int column, int end);
  void paint_pixel_by_pixel(int column, int end);

  Depth format_;
  double front_;
  double rear_limit_;
  typename Depth::Stored rear_;
  double reach_columns_;
  PixelTag background_;
  std::vector<double> depths_;
  std::vector<PixelTag> tags_;
  int first_painted_ = 0;
  int end_painted_ = 0;

  // The state of a sweep.
  std::span<Polygon> polygons_;
  std::vector<ActivePolygon> active_;  // the active polygon list
  Polygon* visible_ = nullptr;         // the nearest active polygon, not counting contenders
  int visible_end_ = 0;                // where it and the contenders are chosen anew
  std::vector<Polygon*> contenders_;   // polygons to compare with it at every pixel
  int run_length_ = 1;                 // columns until the contenders are chosen anew
};

#define PIPELINE_DECLARE(Depth) extern template class RowSweep<Depth>;
PIPELINE_FOR_EACH_DEPTH_FORMAT(PIPELINE_DECLARE)
#undef PIPELINE_DECLARE

}  // namespace pipeline
