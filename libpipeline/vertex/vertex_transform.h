#pragma once

#include <cstddef>

#include "libpipeline/stream/triangle_batch.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "libpipeline/vertex/transform.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {

/// Transforms vertices by p' = M (p - origin): the model transform (origin 0) and the view transform (origin
/// the eye, M the rotation). A kernel transforms blocks of vertices; those that fail its rounding test are
/// calculated again in ball arithmetic.
class VertexTransform {
 public:
  /// The transform from model to world space.
  explicit VertexTransform(const AffineMatrix& world_from_model);
  /// The transform from world to view space.
  explicit VertexTransform(const ViewTransform& view_from_world);

  /// Replaces the triangles and spheres [begin, end) of the batch by their images. An InputError at the
  /// vertex's location on overflow; the batch then keeps the objects before it.
  void apply(TriangleBatch& batch, std::size_t begin, std::size_t end, CoordinateRounder& rounder) const;
  /// Replaces all triangles and spheres of the batch.
  void apply(TriangleBatch& batch, CoordinateRounder& rounder) const {
    apply(batch, 0, batch.object_count(), rounder);
  }
  [[nodiscard]] const AffineMatrix& matrix() const { return matrix_; }

 private:
  void apply(Sphere& sphere, CoordinateRounder& rounder) const;
  void set_coefficients();

  AffineMatrix matrix_;
  bool is_identity_ = false;  // then the images are the vertices themselves
  AffineCoefficients coefficients_;
};

}  // namespace pipeline
