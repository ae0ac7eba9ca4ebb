#include "libpipeline/model_transform.h"

#include <utility>
#include <vector>

namespace pipeline {

ModelTransform::ModelTransform(const AffineMatrix& world_from_model, bool has_normals)
    : world_from_model_(world_from_model) {
  if (has_normals) world_normal_from_model_.emplace(world_from_model);
}

void ModelTransform::apply(TriangleBatch& batch, std::size_t index, CoordinateRounder& rounder) const {
  world_from_model_.apply(batch, index, rounder);
  if (!world_normal_from_model_) return;
  for (Vec3& normal : batch.attributes.normals[index]) normal = (*world_normal_from_model_)(normal);
}

void apply_pending_transforms(TriangleBatch& batch, CoordinateRounder& rounder) {
  const std::vector<PendingTransform> pending = std::exchange(batch.pending_transforms, {});
  std::size_t done_count = 0;
  try {
    for (std::size_t i = 0; i < pending.size(); ++i) {
      const std::size_t end = i + 1 < pending.size() ? pending[i + 1].first_triangle : batch.size();
      for (; done_count < end; ++done_count) pending[i].transform->apply(batch, done_count, rounder);
    }
  } catch (...) {
    batch.truncate(done_count);
    throw;
  }
}

}  // namespace pipeline
