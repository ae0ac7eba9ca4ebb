#pragma once

#include <array>

#include "libpipeline/coordinate_rounder.h"
#include "libpipeline/transform.h"
#include "libpipeline/triangle_batch.h"

namespace pipeline {

/// Takes points from one space to another by p' = M (p - origin): the model transform (origin 0) and the view
/// transform (origin the eye, M the rotation).
class VertexTransform {
 public:
  /// From model to world space.
  explicit VertexTransform(const AffineMatrix& world_from_model);
  /// From world to view space.
  explicit VertexTransform(const ViewTransform& view_from_world);

  /// Replaces triangle `index` of the batch by its image. An InputError with its line on overflow.
  void apply(TriangleBatch& batch, std::size_t index, CoordinateRounder& rounder) const;
  /// Replaces all triangles of the batch; on an error the batch keeps those that were done before.
  void apply(TriangleBatch& batch, CoordinateRounder& rounder) const;

 private:
  /// A row of M in doubles, and for each entry what it adds to the error of an image per unit of the
  /// coordinate (the entry's own error, the subtraction of the origin, the product and the sums).
  struct Row {
    std::array<double, 4> entries{};
    std::array<double, 4> errors{};
  };

  void set_rows();
  [[nodiscard]] bool apply_in_doubles(Vec3& p, const CoordinateRounder& rounder) const;

  AffineMatrix matrix_;
  Vec3 origin_;
  std::array<Row, 3> rows_;
};

}  // namespace pipeline
