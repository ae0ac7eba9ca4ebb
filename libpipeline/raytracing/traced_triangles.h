#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libpipeline/raytracing/ellipsoid.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/projection.h"

namespace pipeline {

/// Rounds calculated triangles as if they had been written in the shortest form (--digits exact) and read
/// back: zeros lose their sign, and every x or y whose text is a decimal in exact arithmetic is marked.
void pass_through_text(TriangleBatch& batch);

/// A surface that rays meet: its id in TracedTriangles.
using SurfaceId = std::uint32_t;
constexpr SurfaceId kNoSurface = ~SurfaceId{0};

/// A sphere of a text in view space.
struct TracedSphere {
  Ellipsoid surface;
  Vec3 color;
  std::uint64_t number;
  std::uint32_t material;
};

/// All triangles of a text, in view space and as `zbuf` reads them from `project --digits exact`, in the
/// order in which it writes them. A cut triangle has one entry per piece; a dropped one has none, unless
/// dropped triangles are kept, for rays that do not come from the eye: then its image has no area. An entry's
/// index is its id. A plain triangle takes 154 bytes (82 as an image alone), colors and normals another 144
/// each. The spheres of the text follow: their ids begin after the last triangle's.
class TracedTriangles {
 public:
  /// `file` names the text in messages. With `is_lit`, pieces keep the triangle they were cut from.
  TracedTriangles(const ProjectionTransform& projection, const std::string& file, bool is_lit)
      : file_(file),
        rounder_(Precision::extended, kShortest, file),
        stage_(projection, ClipMode::automatic, CullMode::nothing, rounder_) {
    if (is_lit) stage_.keep_unclipped_triangles();
  }
  TracedTriangles(const TracedTriangles&) = delete;
  TracedTriangles& operator=(const TracedTriangles&) = delete;

  /// Makes `add` include triangles that `project` drops.
  void keep_dropped() { keeps_dropped_ = true; }
  /// Adds the triangles of a batch, and its spheres. Returns the triangles as `zbuf` reads them, valid until
  /// the next call. An InputError at a sphere whose points lie in a plane.
  const TriangleBatch& add(const TriangleBatch& p_view);
  /// Drops the triangles in view space, needed only to build boxes and for secondary rays.
  void keep_images_alone() {
    p_view_ = {};
    attributes_ = {};
  }

  [[nodiscard]] std::size_t size() const { return p_ndc_.size(); }
  [[nodiscard]] const Triangle& p_view(SurfaceId id) const { return p_view_[id]; }
  /// The number in the scene of a triangle, or of a sphere.
  [[nodiscard]] std::uint64_t number(SurfaceId id) const {
    return is_sphere(id) ? sphere(id).number : numbers_[id];
  }
  /// The images of the triangles, indexed by id, without numbers and locations.
  [[nodiscard]] const TriangleBatch& p_ndc() const { return p_ndc_; }
  /// True if this is the entry that represents the uncut triangle.
  [[nodiscard]] bool is_first(SurfaceId id) const { return are_first_[id]; }
  [[nodiscard]] std::uint32_t material(SurfaceId id) const {
    if (is_sphere(id)) return sphere(id).material;
    return attributes_.materials.empty() ? 0 : attributes_.materials[id];
  }
  [[nodiscard]] const std::vector<TracedSphere>& spheres() const { return spheres_; }
  [[nodiscard]] bool is_sphere(SurfaceId id) const { return id >= size(); }
  [[nodiscard]] const TracedSphere& sphere(SurfaceId id) const { return spheres_[id - size()]; }
  /// The count of triangles and spheres.
  [[nodiscard]] std::size_t surface_count() const { return size() + spheres_.size(); }
  /// The corners' colors and normals; null where the text has none.
  [[nodiscard]] const std::array<Vec3, 3>* colors(SurfaceId id) const {
    return attributes_.colors.empty() ? nullptr : &attributes_.colors[id];
  }
  [[nodiscard]] const std::array<Vec3, 3>* normals(SurfaceId id) const {
    return attributes_.normals.empty() ? nullptr : &attributes_.normals[id];
  }
  [[nodiscard]] const ProjectionStage& stage() const { return stage_; }
  /// The largest |z| in NDC of all vertices.
  [[nodiscard]] double largest_depth() const { return largest_depth_; }

 private:
  void add_entry(const TriangleBatch& p_view, std::size_t index, bool is_first);
  void add_image(std::size_t index);

  std::string file_;
  CoordinateRounder rounder_;
  ProjectionStage stage_;
  TriangleBatch projected_;  // the last batch
  std::vector<TracedSphere> spheres_;
  std::vector<Triangle> p_view_;
  std::vector<std::uint64_t> numbers_;
  std::vector<bool> are_first_;
  AttributeArrays attributes_;
  TriangleBatch p_ndc_;
  double largest_depth_ = 0;
  bool keeps_dropped_ = false;
};

}  // namespace pipeline
