#include "libpipeline/vertex/vertex_transform.h"

#include <algorithm>
#include <span>

namespace pipeline {
namespace {

BallVec3 apply_in_balls(const AffineMatrix& m, const Vec3& origin, const Vec3& p) {
  const BallVec3 from_origin = to_balls(p) - to_balls(origin);
  const auto coordinate = [&](const std::array<Ball, 4>& row) {
    return row[0] * from_origin.x + row[1] * from_origin.y + row[2] * from_origin.z + row[3];
  };
  return {coordinate(m.rows[0]), coordinate(m.rows[1]), coordinate(m.rows[2])};
}

}  // namespace

VertexTransform::VertexTransform(const AffineMatrix& world_from_model) : matrix_(world_from_model) {
  set_coefficients();
}

VertexTransform::VertexTransform(const ViewTransform& view_from_world) {
  const auto row = [](const BallVec3& v) { return std::array<Ball, 4>{v.x, v.y, v.z, Ball()}; };
  matrix_.rows = {row(view_from_world.right), row(view_from_world.up), row(view_from_world.backward)};
  coefficients_.origin = view_from_world.eye;
  set_coefficients();
}

void VertexTransform::set_coefficients() {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) coefficients_.rows[i][j] = Coefficient(matrix_.rows[i][j]);
}

void VertexTransform::apply(TriangleBatch& batch, std::size_t begin, std::size_t end,
                            CoordinateRounder& rounder) const {
  const RoundingTest test = rounder.rounding_test();
  VertexBlock p;
  ImageBlock image;
  for (std::size_t first = begin; first < end; first += VertexBlock::kTriangles) {
    const std::size_t count = std::min(end - first, VertexBlock::kTriangles);
    p.fill(std::span(batch.triangles).subspan(first, count));
    vertex_kernel().transform(coefficients_, test, p, image);
    for (std::size_t i = 0; i < count; ++i) try {
        set_image(batch, first + i, image, 3 * i, rounder);
      } catch (...) {
        batch.truncate(first + i);
        throw;
      }
  }
}

/// Replaces a triangle by its image, which begins at `first_vertex` of the block; vertices that failed the
/// rounding test are calculated again.
void VertexTransform::set_image(TriangleBatch& batch, std::size_t index, const ImageBlock& image,
                                std::size_t first_vertex, CoordinateRounder& rounder) const {
  for (std::size_t v = 0; v < 3; ++v) {
    Vec3& p = batch.triangles[index][v];
    if (image.passes_rounding_test[first_vertex + v] != 0) {
      p = image.vertex(first_vertex + v);
    } else {
      rounder.set_vertex_exactly(batch, index, v, apply_in_balls(matrix_, coefficients_.origin, p));
    }
  }
}

}  // namespace pipeline
