#pragma once

#include <optional>

#include "libpipeline/attribute_transform.h"
#include "libpipeline/coordinate_rounder.h"
#include "libpipeline/transform.h"
#include "libpipeline/triangle_batch.h"
#include "libpipeline/vertex_transform.h"

namespace pipeline {

/// What one matrix of a scene does to the triangles under it: model space to world space.
class ModelTransform {
 public:
  explicit ModelTransform(const AffineMatrix& world_from_model, bool has_normals);

  /// Replaces triangle `index` of the batch, with its normals, by its image. An InputError with its line on
  /// overflow.
  void apply(TriangleBatch& batch, std::size_t index, CoordinateRounder& rounder) const;

 private:
  VertexTransform world_from_model_;
  std::optional<NormalTransform> world_normal_from_model_;
};

/// Applies the transforms that a batch's triangles still wait for; on an error the batch keeps those that
/// were done before.
void apply_pending_transforms(TriangleBatch& batch, CoordinateRounder& rounder);

}  // namespace pipeline
