#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/scene/viewport.h"

namespace pipeline {

/// The rays for which the boxes of a hierarchy are wide enough.
enum class RaysOfBoxes {
  primary,
  any  // any that starts within the bounding box of the scene
};

/// The boxes of all triangles and spheres, for rays through a window: wide enough for the rays' errors, for
/// the digits of `project --digits exact`, and for the rounding of entries and exits. With RaysOfBoxes::any,
/// they also cover errors of 2^-51 of the distance from the ray's start to a box's side or, in
/// SurfaceTriangleTest, a corner; the scene's largest coordinates bound both.
std::vector<Bvh::Primitive> boxes_of(const TracedTriangles& triangles, const PixelRays& rays,
                                     RaysOfBoxes of = RaysOfBoxes::primary);

/// Casts primary rays: searches for a pixel's visible triangle like a ray tracer. For triangles near the ray,
/// the coverage rule `center` decides whether they cover the pixel, and at which depth, as in `zbuf` for the
/// text of `project --digits exact`. So both find the same triangle and depth. For one thread.
class RayCaster {
 public:
  /// The visible triangle and its depth; or a sphere, with the depth of the ray's hit and the visible side.
  struct Seen {
    SurfaceId id;
    double depth;
    bool is_from_within = false;
  };

  /// Caches the spans of each cached triangle on `row_count` rows.
  RayCaster(const TracedTriangles& triangles, const Bvh& bvh, const ProjectionTransform& projection,
            const Viewport& screen, int row_count = 1)
      : triangles_(triangles),
        bvh_(bvh),
        screen_(screen),
        rays_(projection, screen),
        depth_(projection),
        pixels_(screen),
        grid_(screen),
        row_count_(static_cast<std::size_t>(row_count)),
        cache_(kCached) {}

  /// The triangle seen at a pixel between the depth limits, if any. Among equal depths, the earlier triangle
  /// is seen.
  [[nodiscard]] std::optional<Seen> cast(int row, int column);

 private:
  // Neighboring pixels show the same few triangles.
  static constexpr std::size_t kCached = 1024;
  struct CachedSpan {
    int row = -1;
    std::optional<Span> span;
  };
  struct CachedRows {
    SurfaceId id = kNoSurface;
    std::optional<CenterRows> rows;
    std::vector<CachedSpan> spans;
  };

  [[nodiscard]] const std::optional<Span>& span_of(SurfaceId id, int row);
  [[nodiscard]] bool may_cover(SurfaceId id, int row, int column) const;
  [[nodiscard]] std::optional<Seen> triangle_at(SurfaceId id, int row, int column);
  [[nodiscard]] std::optional<Seen> sphere_at(SurfaceId id, const Ray& ray) const;
  [[nodiscard]] bool is_between_limits(double depth) const {
    return depth >= screen_.front && depth < screen_.rear;
  }

  const TracedTriangles& triangles_;
  const Bvh& bvh_;
  Viewport screen_;
  PixelRays rays_;
  NdcDepth depth_;
  PixelGrid pixels_;
  ExactGrid grid_;
  std::size_t row_count_;
  std::vector<CachedRows> cache_;
};

}  // namespace pipeline
