#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/projection.h"

namespace pipeline {

/// Projects triangles of a text as `project --digits exact` does, each to what `zbuf` reads of it.
class ExactProjection {
 public:
  /// `file` names the text in messages. With `is_lit`, pieces keep the triangle they were cut from.
  ExactProjection(const ProjectionTransform& projection, const std::string& file, bool is_lit);
  ExactProjection(const ExactProjection&) = delete;
  ExactProjection& operator=(const ExactProjection&) = delete;

  /// Fills `p_ndc` as ProjectionStage::project does; valid until the next call.
  const TriangleBatch& project(const TriangleBatch& p_view);
  [[nodiscard]] const ProjectionStage& stage() const { return stage_; }

 private:
  CoordinateRounder rounder_;
  ProjectionStage stage_;
  TriangleBatch p_ndc_;
};

/// All triangles of a text in view space, as the list of those that `project` writes: a triangle that it cuts
/// stands there once for each of its pieces, one that it drops does not. The place in that list is a
/// triangle's id. A plain triangle takes 80 bytes, colors and normals another 72 each.
class TracedTriangles {
 public:
  using Id = std::uint32_t;

  /// Adds the triangles of a batch, and calls `look_at(p_view, p_ndc)` for them in one or several batches. An
  /// InputError as ProjectionStage::project throws.
  void add(const TriangleBatch& p_view, ExactProjection& projection,
           const std::function<void(const TriangleBatch& p_view, const TriangleBatch& p_ndc)>& look_at);

  [[nodiscard]] std::size_t size() const { return p_view_.size(); }
  [[nodiscard]] const Triangle& p_view(Id id) const { return p_view_[id]; }
  [[nodiscard]] std::uint64_t number(Id id) const { return numbers_[id]; }
  /// Which piece of its triangle this one is; none if it is whole.
  [[nodiscard]] std::optional<std::size_t> piece(Id id) const {
    if (pieces_.empty() || pieces_[id] == kWhole) return std::nullopt;
    return pieces_[id];
  }
  /// The largest |z| in NDC of all vertices.
  [[nodiscard]] double largest_depth() const { return largest_depth_; }
  /// Adds the triangle, with its columns and without its place in the text, to a batch.
  void copy(Id id, TriangleBatch& p_view) const;

 private:
  static constexpr std::uint8_t kWhole = 255;

  void add_whole(const TriangleBatch& p_view, std::size_t index);

  std::vector<Triangle> p_view_;
  std::vector<std::uint64_t> numbers_;
  std::vector<std::uint8_t> pieces_;  // empty while all are whole
  AttributeArrays attributes_;
  double largest_depth_ = 0;
};

}  // namespace pipeline
