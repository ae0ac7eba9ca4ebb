#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "libpipeline/stream/stage_text.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/clip.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// The choice of triangles to cut or drop before the perspective divide.
enum class ClipMode {
  automatic,  // in perspective, clips at the near plane if a vertex has -z less than near / 1024
  near,       // clips every triangle at the near plane
  frustum,    // clips every triangle at all six planes
  reject,     // drops triangles wholly outside one plane, clips none
  none        // clips and drops none; a vertex not in front of the eye is an error
};

/// The winding, as seen from the eye, of triangles to drop; counterclockwise is front. A triangle seen
/// edge-on, as far as 31 digits can tell, is kept.
enum class CullMode { nothing, back, front };

struct ProjectionCounts {
  std::uint64_t clipped = 0;  // triangles cut
  std::uint64_t pieces = 0;   // triangles made of these
  std::uint64_t outside = 0;  // triangles dropped by clipping
  std::uint64_t culled = 0;   // triangles dropped by their winding
};

/// The project stage: view space to NDC, by way of clip space.
class ProjectionStage {
 public:
  /// Clips and drops at planes pulled in by `clip_inset`, in [0, 1): in NDC, |x|, |y| and |z| inside are at
  /// most 1 - clip_inset. `rounder` must outlive the stage.
  ProjectionStage(const ProjectionTransform& projection, ClipMode clip, CullMode cull,
                  CoordinateRounder& rounder, double clip_inset = 0);

  /// Fills `p_ndc` with the images of the triangles in `p_view`, in order. A clipped triangle becomes a fan
  /// of pieces, all with its number; a dropped one is left out. Attributes are interpolated linearly in clip
  /// space, and w is added to them; normals are not normalized again, so that a piece is shaded like the
  /// whole. An InputError at the vertex's location if w <= 0 in a vertex to be divided, or an image
  /// overflows; `p_ndc` then holds the images of the triangles before it. Colors and normals of cut vertices
  /// are calculated in doubles: within 1e-12 and 1e-14 of the exact means.
  void project(const TriangleBatch& p_view, TriangleBatch& p_ndc);

  /// Makes pieces keep the triangle they were cut from (TriangleBatch::unclipped), for lighting.
  void keep_unclipped_triangles() { keeps_unclipped_ = true; }

  /// Makes the stage write w with every vertex. A triangle that clipping drops, but might keep if its
  /// vertices moved by up to `error`, is passed on as a piece without area. All pieces keep their uncut
  /// triangle. Not for the clip modes frustum, reject and none.
  void keep_bounds(const ErrorBound& error) {
    error_ = error;
    keeps_unclipped_ = true;
    rounder_.keep_bounds();
  }

  [[nodiscard]] const ProjectionCounts& counts() const { return counts_; }
  /// True if the stage drops triangles of this winding.
  [[nodiscard]] bool culls(const Triangle& p_view) const {
    return cull_ != CullMode::nothing && is_culled(p_view);
  }

 private:
  /// A vertex as a weighted mean of its triangle's corners, and its w.
  struct CornerMix {
    std::array<double, 3> weights;
    double w;
  };

  enum class Fate { stays_whole, is_dropped, is_unsure };

  using Piece = std::array<const ClipVertex*, 3>;

  [[nodiscard]] double w_of(const Vec3& p_view) const { return projection_.is_perspective ? -p_view.z : 1; }
  [[nodiscard]] bool is_culled(const Triangle& p_view) const;
  /// True if the clip mode applies to every triangle.
  [[nodiscard]] bool clips_all() const { return clip_ != ClipMode::automatic && clip_ != ClipMode::none; }
  [[nodiscard]] bool may_clip(const Triangle& p_view) const {
    if (clip_ != ClipMode::automatic) return clip_ != ClipMode::none;
    // Multiplication by a power of two is exact; an infinite product compares as it should.
    const auto is_near = [&](const Vec3& p) { return -p.z * 1024 < projection_.near; };
    return projection_.is_perspective && (is_near(p_view[0]) || is_near(p_view[1]) || is_near(p_view[2]));
  }
  /// The effect of clipping on a triangle, as far as doubles decide it.
  [[nodiscard]] Fate fate_of(const CertainSides& sides) const;
  /// The planes that drop triangles: bit i for kAllClipPlanes[i].
  [[nodiscard]] unsigned planes() const {
    return clip_ == ClipMode::frustum || clip_ == ClipMode::reject ? SideBlock::kAllPlanes : 1u;
  }
  void add_attributes(const TriangleBatch& p_view, std::size_t index, const std::array<CornerMix, 3>& mixes,
                      TriangleBatch& p_ndc);
  void project_triangle(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);
  void project_or_clip(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);
  void project_unclipped(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);
  void project_clipped(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);
  [[nodiscard]] std::array<ClipVertex, 3> corners_in_clip_space(const Triangle& p_view) const;
  [[nodiscard]] bool may_be_inside(const Triangle& p_view) const;
  /// Drops a triangle that is outside, or passes it on if it might be inside within the error bounds.
  void drop_outside(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc) {
    ++counts_.outside;
    if (error_ && may_be_inside(p_view.triangles[index])) add_possible(p_view, index, p_ndc);
  }
  void add_possible(const TriangleBatch& p_view, std::size_t index, TriangleBatch& p_ndc);
  [[nodiscard]] std::vector<ClipVertex> clipped(const std::array<ClipVertex, 3>& corners,
                                                const Triangle& p_view) const;
  [[nodiscard]] std::optional<Vec3> image_of_corner(const ClipVertex& vertex, std::size_t index) const;
  void add_piece(const TriangleBatch& p_view, std::size_t index, const Piece& piece, TriangleBatch& p_ndc);
  [[nodiscard]] std::shared_ptr<const ClipTriangle> unclipped_in_clip_space(
      const std::array<ClipVertex, 3>& corners, const TriangleBatch& p_view, std::size_t index);

  ProjectionTransform projection_;
  ClipMode clip_;
  CullMode cull_;
  double clip_inset_;
  CoordinateRounder& rounder_;
  ProjectionCoefficients coefficients_;
  VertexBlock vertices_;  // the block around the current triangle
  ImageBlock block_;      // the images of `vertices_`
  bool has_images_ = false;
  std::array<ClipVertex, 3> corners_;  // of the triangle being cut
  SideBlock sides_;                    // the corners' sides, unless the clip mode is automatic or none
  bool mirrored_;                      // one axis is mirrored, so the winding changes
  bool keeps_unclipped_ = false;
  std::optional<ErrorBound> error_;  // of the text read, if bounds are kept
  bool writes_w_ = false;            // with this batch's triangles
  ProjectionCounts counts_;
};

/// The header of a text projected by `projection`, which comes from `given`: without a camera, with a column
/// w if there are columns, with the view volume if there are lights, and with both if there are bounds. An
/// InputError at `given.location` if a plane of the volume is beyond a double's range.
StageHeader projected_header(const StageHeader& p_view, const Located<Projection>& given,
                             const ProjectionTransform& projection);

}  // namespace pipeline
