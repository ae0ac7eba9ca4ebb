#include "libpipeline/vertex/model_transform.h"

#include <utility>
#include <vector>

namespace pipeline {

ModelTransform::ModelTransform(const AffineMatrix& world_from_model, bool has_normals)
    : world_from_model_(world_from_model) {
  if (has_normals) world_normal_from_model_.emplace(world_from_model);
}

void ModelTransform::apply(TriangleBatch& batch, std::size_t begin, std::size_t end,
                           CoordinateRounder& rounder) const {
  if (world_normal_from_model_)
    for (std::size_t i = begin; i < end; ++i)
      for (Vec3& normal : batch.attributes.normals[i]) normal = (*world_normal_from_model_)(normal);
  world_from_model_.apply(batch, begin, end, rounder);
}

void apply_pending_transforms(TriangleBatch& batch, CoordinateRounder& rounder) {
  const std::vector<PendingTransform> pending = std::exchange(batch.pending_transforms, {});
  for (std::size_t i = 0; i < pending.size(); ++i) {
    const std::size_t end = i + 1 < pending.size() ? pending[i + 1].first_triangle : batch.size();
    pending[i].transform->apply(batch, pending[i].first_triangle, end, rounder);
  }
}

}  // namespace pipeline
