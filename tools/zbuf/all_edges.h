#pragma once

#include <functional>
#include <memory>
#include <span>

#include "libpipeline/coverage/span.h"
#include "libpipeline/picture/wireframe.h"
#include "libpipeline/stream/triangle_batch.h"
#include "tools/zbuf/zbuf_options.h"

namespace pipeline {

/// The picture of `--wireframe all`: at every pixel, or sample, the nearest of the fragments that are near an
/// edge of their triangle, whether a surface hides them or not. Takes triangles in the order of the stream.
class AllEdges {
 public:
  virtual ~AllEdges() = default;
  /// Takes the next triangle, number `id` of the wireframe, which has to have its edges already. They are
  /// looked at with the next one, as it may show that one of them is a cut.
  virtual void add(const TriangleBatch& p_ndc, std::size_t index, PixelTag id, const Wireframe& edges) = 0;
  /// The ids seen in a row; after the last triangle.
  virtual std::span<const PixelTag> row(int row, const Wireframe& edges) = 0;
  /// Calls `visit(id)`, which may change it, for every pixel with a triangle.
  virtual void for_each_id(const std::function<void(PixelTag&)>& visit) = 0;
};

/// With the coverage rule and the depth format in use, on a screen of pixels or of samples; null unless it is
/// requested.
std::unique_ptr<AllEdges> all_edges(const ZbufOptions& chosen, const Viewport& screen);

}  // namespace pipeline
