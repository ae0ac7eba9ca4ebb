#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/clip.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// Which triangles are cut or dropped before the perspective divide.
enum class ClipMode {
  automatic,  // cut at the near plane what comes nearer to the eye plane than near / 1024; the rest unchanged
  near,       // cut everything at the near plane
  frustum,    // cut everything at all six planes
  reject,     // drop what lies wholly outside one plane, cut nothing
  none        // a vertex that is not in front of the eye is an error
};

/// Which triangles are dropped by their winding as seen from the eye; counter-clockwise is front. One that is
/// seen so nearly from the edge that 31 digits cannot tell is kept.
enum class CullMode { nothing, back, front };

struct ProjectionCounts {
  std::uint64_t clipped = 0;  // triangles that were cut
  std::uint64_t pieces = 0;   // what they were cut into
  std::uint64_t outside = 0;  // triangles dropped because nothing of them is inside
  std::uint64_t culled = 0;   // triangles dropped by their winding

  ProjectionCounts& operator+=(const ProjectionCounts& other) {
    clipped += other.clipped;
    pieces += other.pieces;
    outside += other.outside;
    culled += other.culled;
    return *this;
  }
};

/// The project stage: view space to NDC, by way of clip space.
class ProjectionStage {
 public:
  /// Cuts and drops take place at planes pulled in by `clip_inset`, from 0 to less than 1: what is inside has
  /// |x|, |y| and |z| of at most 1 - clip_inset in NDC.
  ProjectionStage(const ProjectionTransform& projection, ClipMode clip, CullMode cull,
                  CoordinateRounder& rounder, double clip_inset = 0);

  /// Fills `p_ndc` with the images of the triangles in `p_view`, in order. A clipped triangle becomes several
  /// with its number, a dropped one none. Attributes are interpolated in clip space (normals are not made
  /// unit vectors again, so that a piece shades like the whole), and w joins them. An InputError with the
  /// vertex's line if a vertex that has to be divided is not in front of the eye; `p_ndc` then holds the
  /// images of the triangles before it.
  void project(const TriangleBatch& p_view, TriangleBatch& p_ndc);

  /// From now on pieces say of which triangle they are, which lighting needs: see TriangleBatch::unclipped.
  void keep_clipped_triangles() { keeps_clipped_ = true; }

  [[nodiscard]] const ProjectionCounts& counts() const { return counts_; }

 private:
  /// What a vertex of a piece has of its triangle's corners, and its w.
  struct CornerMix {
    std::array<double, 3> weights;
    double w;
  };

  [[nodiscard]] double w_of(const Vec3& p_view) const { return projection_.is_perspective ? -p_view.z : 1; }
  [[nodiscard]] bool is_culled(const Triangle& p_view) const;
  [[nodiscard]] bool needs_clipping(const Triangle& p_view) const;
  void add_attributes(const TriangleBatch& p_view, std::size_t index, const std::array<CornerMix, 3>& mixes,
                      TriangleBatch& p_ndc);
  void project_triangle(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);
  void project_whole(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);
  void project_clipped(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);

  ProjectionTransform projection_;
  ClipMode clip_;
  CullMode cull_;
  double clip_extent_;
  CoordinateRounder& rounder_;
  ProjectionCoefficients coefficients_;
  ImageBlock block_;  // the images of the triangles around the one that is projected
  bool mirrored_;
  bool keeps_clipped_ = false;
  ProjectionCounts counts_;
};

}  // namespace pipeline
