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

std::array<Ball, 4> row_of(const BallVec3& v) {
  return {v.x, v.y, v.z, Ball()};
}

}  // namespace

VertexTransform::VertexTransform(const AffineMatrix& world_from_model)
    : matrix_(world_from_model), is_identity_(world_from_model.rows == identity().rows) {
  set_coefficients();
}

VertexTransform::VertexTransform(const ViewTransform& view_from_world)
    : matrix_({row_of(view_from_world.right), row_of(view_from_world.up), row_of(view_from_world.backward)},
              1) {
  coefficients_.origin = view_from_world.eye;
  set_coefficients();
}

void VertexTransform::set_coefficients() {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) coefficients_.rows[i][j] = Coefficient(matrix_.rows[i][j]);
}

void VertexTransform::apply(TriangleBatch& batch, std::size_t begin, std::size_t end,
                            CoordinateRounder& rounder) const {
  if (is_identity_) return;
  RoundingTest test = rounder.rounding_test();
  VertexBlock p;
  ImageBlock image;
  const std::size_t end_of_triangles = std::min(end, batch.size());
  std::size_t i = begin;
  try {
    while (i < end_of_triangles) {
      const std::size_t count = std::min(end_of_triangles - i, VertexBlock::kTriangles);
      p.fill(std::span(batch.triangles).subspan(i, count));
      vertex_kernel().transform(coefficients_, test, p, image);
      // Doubles cannot decide the last decimal of numbers this large, and more of them will follow.
      if (!test.needs_pairs && image.passes_rounding_test[0] == 0) {
        test.needs_pairs = true;
        vertex_kernel().transform(coefficients_, test, p, image);
      }
      for (std::size_t index = 0; index < count; ++index, ++i)
        for (std::size_t v = 0; v < 3; ++v)
          if (const std::size_t at = 3 * index + v; image.passes_rounding_test[at] != 0)
            batch.triangles[i][v] = image.vertex(at);
          else
            rounder.set_vertex_exactly(batch, i, v,
                                       apply_in_balls(matrix_, coefficients_.origin, p.vertex(at)),
                                       size_of(p.triangle(index)));
    }
    for (; i < end; ++i) apply(batch.spheres[i - batch.size()], rounder);
  } catch (...) {
    batch.truncate(i);
    throw;
  }
}

void VertexTransform::apply(Sphere& sphere, CoordinateRounder& rounder) const {
  const auto [center, i, j, k] = sphere.points;
  VertexBlock p;
  ImageBlock image;
  p.fill(std::array{Triangle{center, i, j}, Triangle{k, center, center}});
  vertex_kernel().transform(coefficients_, rounder.rounding_test(), p, image);
  for (std::size_t v = 0; v < sphere.points.size(); ++v) {
    PrintablePoint rounded = {.hi = image.vertex(v), .lo = {}};
    if (image.passes_rounding_test[v] == 0)
      rounded = rounder.rounded_exactly(apply_in_balls(matrix_, coefficients_.origin, p.vertex(v)),
                                        sphere.locations[v], size_of(p.triangle(v / 3)));
    sphere.points[v] = rounded.hi;
    sphere.low_parts[v] = rounded.lo;
  }
}

}  // namespace pipeline
