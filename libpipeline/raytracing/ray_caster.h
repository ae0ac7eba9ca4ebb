#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "libpipeline/coverage/center.h"
#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/ndc_depth.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/raytracing/triangle_test.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"

namespace pipeline {

/// Which rays the boxes of a hierarchy are wide enough for.
enum class RaysOfBoxes {
  primary,
  any  // that starts between the least and the greatest coordinates of the scene
};

/// The hierarchy of all triangles and spheres, for rays through a window: boxes are wide enough for the
/// errors that TriangleTest allows for, and for the entries and exits of boxes. For any ray, too: the entry
/// into a box is rounded by 2^-51 of the distance from the ray's start to the side, and a corner as
/// SurfaceTriangleTest sees it by 2^-51 of its distance from there; the scene's largest coordinates bound
/// both.
Bvh hierarchy_of(const TracedTriangles& triangles, const PixelRays& rays, ThreadPool& pool,
                 RaysOfBoxes of = RaysOfBoxes::primary);

/// Asks the coverage rule `center` and its depth for single pixels, as `zbuf` does for the text that
/// `project --digits exact` writes. For one thread.
class ExactFragments {
 public:
  ExactFragments(const TracedTriangles& triangles, const ProjectionTransform& projection,
                 const Viewport& screen)
      : triangles_(triangles), grid_(screen), projection_(projection, "", false), cache_(kCached) {}

  /// The depth of a triangle at a pixel; none if it does not cover the pixel's center.
  [[nodiscard]] std::optional<double> depth(TracedTriangles::Id id, int row, int column);
  /// How often it was asked.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  // Neighboring pixels show the same few triangles.
  static constexpr std::size_t kCached = 256;
  struct CachedRows {
    std::optional<TracedTriangles::Id> id;
    std::optional<CenterRows> rows;
  };

  const CenterRows& rows_of(TracedTriangles::Id id);

  const TracedTriangles& triangles_;
  ExactGrid grid_;
  ExactProjection projection_;
  TriangleBatch p_view_;
  std::vector<CachedRows> cache_;
  std::uint64_t count_ = 0;
};

/// Casts primary rays: finds the triangle that a pixel shows by the search of a ray tracer, and decides as
/// the z-buffer with the rule `center` does, wherever the search cannot tell. So it finds the same triangle
/// and, on request, the same depth. For one thread.
class RayCaster {
 public:
  /// The visible triangle and its depth, which is exact only where it is requested. Or a sphere, whose depth
  /// is that of the ray's hit, and whose id says which side is seen (TracedTriangles::kFromWithin).
  struct Seen {
    TracedTriangles::Id id;
    double depth;
  };

  RayCaster(const TracedTriangles& triangles, const Bvh& bvh, const ProjectionTransform& projection,
            const Viewport& screen)
      : triangles_(triangles),
        bvh_(bvh),
        screen_(screen),
        rays_(projection, screen),
        depth_(projection),
        test_(rays_, depth_),
        exact_(triangles, projection, screen) {}

  /// The triangle seen at a pixel, between the depth limits; none if there is none.
  std::optional<Seen> cast(int row, int column, bool wants_depth);
  /// The number of exact evaluations.
  [[nodiscard]] std::uint64_t exact_count() const { return exact_.count(); }

 private:
  struct Candidate {
    TracedTriangles::Id id;
    DepthInterval depth;
    bool is_exact;
  };

  [[nodiscard]] std::optional<Candidate> candidate(TracedTriangles::Id id, const Ray& ray);
  [[nodiscard]] std::optional<Candidate> exact_candidate(TracedTriangles::Id id);
  [[nodiscard]] std::optional<Candidate> sphere_candidate(TracedTriangles::Id id, const Ray& ray) const;
  [[nodiscard]] std::optional<Candidate> made_exact(const Candidate& candidate) {
    return candidate.is_exact ? candidate : exact_candidate(candidate.id);
  }
  void take_nearer(const Candidate& next);

  const TracedTriangles& triangles_;
  const Bvh& bvh_;
  Viewport screen_;
  PixelRays rays_;
  NdcDepth depth_;
  TriangleTest test_;
  ExactFragments exact_;
  int row_ = 0, column_ = 0;
  std::optional<Candidate> nearest_;
};

}  // namespace pipeline
