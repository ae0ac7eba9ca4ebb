#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "libpipeline/raytracing/ellipsoid.h"
#include "libpipeline/raytracing/exact_projection.h"
#include "libpipeline/stream/triangle_batch.h"

namespace pipeline {

/// A sphere of a text in view space; it takes 248 bytes.
struct TracedSphere {
  Ellipsoid surface;
  std::optional<Vec3> color;  // none if the text has no colors
  std::uint64_t number;
  std::uint32_t material;
};

/// All triangles of a text in view space, in the order in which `project` writes them. A cut triangle has one
/// entry per piece; a dropped one has none, unless dropped ones are kept for rays from elsewhere than the
/// eye. An entry's index is its id. A plain triangle takes 80 bytes, colors and normals another 72 each. The
/// spheres of the text follow: their ids begin after the last triangle's.
class TracedTriangles {
 public:
  using Id = std::uint32_t;
  /// Watches triangles of a text, before and after their projection.
  using Watcher = std::function<void(const TriangleBatch& p_view, const TriangleBatch& p_ndc)>;

  /// From now on, adds triangles that `project` drops, too.
  void keep_dropped() { keeps_dropped_ = true; }
  /// Adds the triangles of a batch, and calls `look_at` for them in one or several batches; adds its spheres.
  /// An InputError as ProjectionStage::project throws, or at a sphere whose points lie in a plane.
  void add(const TriangleBatch& p_view, ExactProjection& projection, const Watcher& look_at);

  [[nodiscard]] std::size_t size() const { return p_view_.size(); }
  [[nodiscard]] const Triangle& p_view(Id id) const { return p_view_[id]; }
  /// The number in the scene of a triangle, or of a sphere.
  [[nodiscard]] std::uint64_t number(Id id) const { return is_sphere(id) ? sphere(id).number : numbers_[id]; }
  /// Which piece of its triangle this one is; none if it is whole or not projected.
  [[nodiscard]] std::optional<std::size_t> piece(Id id) const {
    if (pieces_.empty() || pieces_[id] >= kDropped) return std::nullopt;
    return pieces_[id];
  }
  /// Whether `project` drops it.
  [[nodiscard]] bool is_dropped(Id id) const { return !pieces_.empty() && pieces_[id] == kDropped; }
  /// Whether this is the entry that represents the uncut triangle.
  [[nodiscard]] bool is_first(Id id) const { return piece(id).value_or(0) == 0; }
  [[nodiscard]] std::uint32_t material(Id id) const {
    if (is_sphere(id)) return sphere(id).material;
    return attributes_.materials.empty() ? 0 : attributes_.materials[id];
  }
  /// In the id of a sphere that a primary ray sees: the ray sees it from within.
  static constexpr Id kFromWithin = Id{1} << 31;
  [[nodiscard]] const std::vector<TracedSphere>& spheres() const { return spheres_; }
  [[nodiscard]] bool is_sphere(Id id) const { return id >= size(); }
  [[nodiscard]] const TracedSphere& sphere(Id id) const { return spheres_[(id & ~kFromWithin) - size()]; }
  /// The count of triangles and spheres.
  [[nodiscard]] std::size_t surface_count() const { return size() + spheres_.size(); }
  /// The corners' colors and normals; null where the text has none.
  [[nodiscard]] const std::array<Vec3, 3>* colors(Id id) const {
    return attributes_.colors.empty() ? nullptr : &attributes_.colors[id];
  }
  [[nodiscard]] const std::array<Vec3, 3>* normals(Id id) const {
    return attributes_.normals.empty() ? nullptr : &attributes_.normals[id];
  }
  /// The largest |z| in NDC of all vertices.
  [[nodiscard]] double largest_depth() const { return largest_depth_; }
  /// Adds the triangle, with its columns and without its place in the text, to a batch.
  void copy(Id id, TriangleBatch& p_view) const;

 private:
  static constexpr std::uint8_t kWhole = 255;
  static constexpr std::uint8_t kDropped = 254;

  void add_triangles(const TriangleBatch& p_view, ExactProjection& projection, const Watcher& look_at);
  void add_entry(const TriangleBatch& p_view, std::size_t index, std::uint8_t piece);

  std::vector<TracedSphere> spheres_;
  std::vector<Triangle> p_view_;
  std::vector<std::uint64_t> numbers_;
  std::vector<std::uint8_t> pieces_;  // empty while all are whole
  AttributeArrays attributes_;
  double largest_depth_ = 0;
  bool keeps_dropped_ = false;
};

}  // namespace pipeline
