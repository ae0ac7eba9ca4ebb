#pragma once

#include <array>
#include <cmath>
#include <span>

#include "libpipeline/scene/appearance.h"
#include "libpipeline/text/vertex_columns.h"
#include "libpipeline/vertex/affine_matrix.h"
#include "libpipeline/vertex/coordinate_rounder.h"
#include "libpipeline/vertex/transform.h"

namespace pipeline {

/// Transforms normals by the inverse transpose of the linear part M of the points' transform, so that they
/// stay perpendicular to their surface under any scaling and on their side of it under a reflection.
/// Calculated as sign(det M) times the cofactors of M, which exist for a singular M, too: if M flattens space
/// to a plane, all normals become the plane's, and a normal without a direction becomes 0 (its triangle has
/// no area). Normals are calculated in doubles: each component is within 1e-15 * r of its exact value, where
/// r is the product, over all scalings in M, of the ratio of the largest to the smallest factor. Where nearly
/// all of a normal is lost (r beyond 10^12, or M singular), it is calculated again with balls; it is 0 if
/// these do not determine its direction to seven digits.
class NormalTransform {
 public:
  explicit NormalTransform(const AffineMatrix& world_from_model);
  explicit NormalTransform(const ViewTransform& view_from_world);

  /// The image, of length 1 or 0, of a normal of any length.
  [[nodiscard]] Vec3 operator()(const Vec3& normal) const;
  /// The image calculated with balls.
  [[nodiscard]] Vec3 image_in_balls(const BallVec3& normal) const;
  /// True if doubles keep eight digits of every normal.
  [[nodiscard]] bool keeps_digits() const { return std::fabs(determinant_) > 0x1p-20; }
  /// Replaces the normals of the triangles [begin, end), if there are any, by their images.
  void apply(AttributeArrays& attributes, std::size_t begin, std::size_t end) const;

 private:
  void apply(std::span<Vec3> normals) const;

  std::array<Vec3, 3> rows_;
  // Of rows_, whose largest entry is 1: at most 9 times the length of any unit vector's image.
  double determinant_ = 0;
  std::array<BallVec3, 3> ball_rows_;  // only for the model's transforms: a view loses no digits
};

/// The light with its position transformed and rounded to doubles, like a vertex's (round_to_text); added to
/// `uncertain` if not all its digits are certain. An InputError at the light's location if the position
/// leaves a double's range.
Located<Light> transformed(const AffineMatrix& world_from_model, const Located<Light>& light,
                           UncertainDigits& uncertain);
Located<Light> transformed(const ViewTransform& view_from_world, const Located<Light>& light,
                           UncertainDigits& uncertain);

}  // namespace pipeline
