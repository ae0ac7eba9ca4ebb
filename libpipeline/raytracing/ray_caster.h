#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "libpipeline/coverage/exact_grid.h"
#include "libpipeline/raytracing/bvh.h"
#include "libpipeline/raytracing/exact_fragment.h"
#include "libpipeline/raytracing/ndc_depth.h"
#include "libpipeline/raytracing/pixel_rays.h"
#include "libpipeline/raytracing/traced_triangles.h"
#include "libpipeline/raytracing/triangle_test.h"
#include "libpipeline/scene/viewport.h"
#include "libpipeline/stream/thread_pool.h"

namespace pipeline {

/// The hierarchy of all triangles, for primary rays through a window: boxes are wide enough for the errors
/// that TriangleTest allows for, and for the entries and exits of boxes.
Bvh hierarchy_of(const TracedTriangles& triangles, const PixelRays& rays, ThreadPool& pool);

/// Casts primary rays: finds the triangle that a pixel shows by the search of a ray tracer, and decides as
/// the z-buffer with the rule `center` does, wherever the search cannot tell. So it finds the same triangle
/// and, on request, the same depth.
class RayCaster {
 public:
  /// The visible triangle and its depth, which is exact only where it is requested.
  struct Seen {
    TracedTriangles::Id id;
    double depth;
  };

  RayCaster(const TracedTriangles& triangles, const Bvh& bvh, const ProjectionTransform& projection,
            const Viewport& screen)
      : triangles_(triangles),
        bvh_(bvh),
        projection_(projection),
        screen_(screen),
        grid_(screen),
        rays_(projection, screen),
        depth_(projection),
        test_(rays_, depth_) {}

  /// One for each thread.
  class Thread {
   public:
    explicit Thread(const RayCaster& caster)
        : caster_(caster), exact_(caster.triangles_, caster.projection_, caster.grid_) {}

    /// The triangle seen at a pixel, between the depth limits; none if there is none.
    std::optional<Seen> cast(int row, int column, bool wants_depth);
    /// How often doubles could not tell, or a depth was requested.
    [[nodiscard]] std::uint64_t exact_count() const { return exact_.count(); }

   private:
    struct Candidate {
      TracedTriangles::Id id;
      DepthInterval depth;
      bool is_exact;
    };

    [[nodiscard]] std::optional<Candidate> candidate(TracedTriangles::Id id, const Ray& ray);
    [[nodiscard]] std::optional<Candidate> exact_candidate(TracedTriangles::Id id);
    [[nodiscard]] std::optional<Candidate> made_exact(const Candidate& candidate);
    void take_nearer(const Candidate& next);

    const RayCaster& caster_;
    ExactFragments exact_;
    int row_ = 0, column_ = 0;
    std::optional<Candidate> nearest_;
  };

 private:
  const TracedTriangles& triangles_;
  const Bvh& bvh_;
  ProjectionTransform projection_;
  Viewport screen_;
  ExactGrid grid_;
  PixelRays rays_;
  NdcDepth depth_;
  TriangleTest test_;
};

}  // namespace pipeline
