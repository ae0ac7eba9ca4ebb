#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "libpipeline/coverage/span.h"
#include "libpipeline/picture/wireframe.h"
#include "libpipeline/scene/pixel_grid.h"
#include "libpipeline/stream/kept_ids.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/visibility/fragment_log.h"
#include "libpipeline/visibility/pixel_rules.h"
#include "libpipeline/visibility/raster.h"

namespace pipeline {

/// The picture of `--wireframe all`: at every pixel, or sample, the nearest of the fragments that are near an
/// edge of their triangle, whether a surface hides them or not. Takes triangles in the order of the stream.
class AllEdges {
 public:
  /// For a screen of pixels or of samples.
  AllEdges(const PixelRules& rules, const Viewport& screen);

  /// Takes the next triangle, number `id` of the wireframe, which has to have its edges already. They are
  /// looked at with the next one, as it may show that one of them is a cut.
  void add(const TriangleBatch& p_ndc, std::size_t index, PixelTag id, const Wireframe& edges);
  /// The ids seen in a row; after the last triangle.
  std::span<const PixelTag> row(int row, const Wireframe& edges);
  /// Calls `visit(id)`, which may change it, for every pixel with a triangle.
  template <typename Visitor>
  void for_each_id(Visitor&& visit) {
    for (int row = seen_.row_range().first; row < seen_.row_range().end; ++row)
      for (FragmentTest::Seen& seen : seen_.row(row)) {
        PixelTag id = id_of(seen);
        visit(id);
        seen.triangle = id;
      }
    if (!last_.empty()) visit(last_id_);
  }

 private:
  static PixelTag id_of(const FragmentTest::Seen& seen) { return static_cast<PixelTag>(seen.triangle); }
  void draw_last(const Wireframe& edges);

  PixelGrid grid_;
  AnyCoverage coverage_;
  FragmentTest test_;
  Raster<FragmentTest::Seen> seen_;
  std::vector<PixelTag> ids_;
  std::vector<Span> last_;  // of the triangle added last
  PixelTag last_id_ = 0;
};

}  // namespace pipeline
