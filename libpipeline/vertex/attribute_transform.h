#pragma once

#include <array>

#include "libpipeline/scene/appearance.h"
#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/affine_matrix.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// Takes normals from one space to another: by the inverse transpose of the linear part M of the transform
/// that the points meet, so that they stay normal under any scale and keep their side under a mirroring.
/// Calculated as sign(det M) times M's cofactors, which a singular M has, too: what it makes flat keeps the
/// normals of the plane, and normals that it leaves no direction become 0 (they belong to triangles without
/// area).
class NormalTransform {
 public:
  explicit NormalTransform(const AffineMatrix& world_from_model);
  explicit NormalTransform(const ViewTransform& view_from_world);

  /// The image of a normal, of length 1 or 0.
  [[nodiscard]] Vec3 operator()(const Vec3& normal) const;

 private:
  void set_rows(const BallVec3& x, const BallVec3& y, const BallVec3& z);

  std::array<Vec3, 3> rows_;
};

/// The light where the transform takes it. An InputError at its place if that is beyond a double's range.
Located<Light> transformed(const AffineMatrix& world_from_model, const Located<Light>& light);
Located<Light> transformed(const ViewTransform& view_from_world, const Located<Light>& light);

}  // namespace pipeline
