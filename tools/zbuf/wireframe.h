#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "libpipeline/coverage/edge_pixels.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// The picture of `--wireframe`: at every pixel or sample, the nearest edge that no triangle hides. Takes
/// triangles in the order of the stream, whatever the visibility algorithm.
class Wireframe {
 public:
  struct Setup {
    bool shows_hidden = false;
    bool says_what_was_clipped = false;  // true for texts with lights
    int samples_per_pixel = 1;           // in a row or a column
  };

  /// `screen` has pixels or samples.
  Wireframe(const PixelRules& rules, const Viewport& screen, const Setup& setup);

  /// Takes the next triangle, with its id, the count so far. Its edges are drawn at the next `add` or `row`,
  /// as the next triangle may be a piece that shares one.
  void add(const TriangleBatch& p_ndc, std::size_t index, PixelTag id);
  /// The ids shown in a row whose visible surfaces are these; to be called after the last triangle.
  std::span<const PixelTag> row(int row, const VisibleRow& surfaces);
  /// Calls `visit(id)`, which may change the id, for every triangle that the picture needs, now or later,
  /// besides the visible surfaces.
  template <typename Visitor>
  void for_each_id(Visitor&& visit) {
    for (int row = edges_.row_range().first; row < edges_.row_range().end; ++row)
      for (Edge& edge : edges_.row(row)) visit(edge.id);
    if (last_) visit(last_->id);
  }
  /// Drops the triangles that are not kept.
  void keep(const KeptIds& kept) { surfaces_.keep(kept); }

 private:
  static constexpr PixelTag kNone = KeptIds::kNoTriangle;
  /// The nearest edge at a pixel.
  struct Edge {
    double depth;
    PixelTag id = kNone;
    bool is_front = true;  // the triangle's corners run counterclockwise
  };
  /// A triangle hides all that is farther than all its corners, or farther than itself by more than `reach`.
  struct Surface {
    double most, reach;
    bool is_front;
  };
  struct Last {
    Triangle p_ndc;
    std::uint64_t number;
    PixelTag id;
  };

  [[nodiscard]] Surface surface(const Triangle& p_ndc) const;
  void draw_last(bool is_closed = true);

  Setup setup_;
  Viewport screen_;
  AnyDepth depth_;
  ExactGrid grid_;
  Raster<Edge> edges_;
  ChunkedArray<Surface> surfaces_;  // by the ids of their triangles
  std::optional<Last> last_;
  std::vector<EdgePixel> pixels_;  // of the last triangle
  std::vector<PixelTag> ids_;
};

}  // namespace pipeline
