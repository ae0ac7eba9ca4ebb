#pragma once

#include <optional>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/attribute_transform.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_transform.h"

namespace pipeline {

/// What one matrix of a scene does to the triangles under it: model space to world space.
class ModelTransform {
 public:
  explicit ModelTransform(const AffineMatrix& world_from_model, bool has_normals);

  /// Replaces the triangles of the batch from `begin` to before `end`, with their normals, by their images.
  /// An InputError with the vertex's line on overflow; the batch then keeps those before that triangle.
  void apply(TriangleBatch& batch, std::size_t begin, std::size_t end, CoordinateRounder& rounder) const;

 private:
  VertexTransform world_from_model_;
  std::optional<NormalTransform> world_normal_from_model_;
};

/// Applies the transforms that a batch's triangles still wait for; on an error the batch keeps those that
/// were done before.
void apply_pending_transforms(TriangleBatch& batch, CoordinateRounder& rounder);

}  // namespace pipeline
