#include "libpipeline/vertex_transform.h"

#include <cmath>

namespace pipeline {
namespace {

// Half an ulp of 1: the relative error of one operation in doubles.
constexpr double kUnit = 0x1p-53;

BallVec3 apply_in_balls(const AffineMatrix& m, const Vec3& origin, const Vec3& p) {
  const BallVec3 from_origin = to_balls(p) - to_balls(origin);
  const auto coordinate = [&](const std::array<Ball, 4>& row) {
    return row[0] * from_origin.x + row[1] * from_origin.y + row[2] * from_origin.z + row[3];
  };
  return {coordinate(m.rows[0]), coordinate(m.rows[1]), coordinate(m.rows[2])};
}

}  // namespace

VertexTransform::VertexTransform(const AffineMatrix& world_from_model) : matrix_(world_from_model) {
  set_rows();
}

VertexTransform::VertexTransform(const ViewTransform& view_from_world) : origin_(view_from_world.eye) {
  const auto row = [](const BallVec3& v) { return std::array<Ball, 4>{v.x, v.y, v.z, Ball()}; };
  matrix_.rows = {row(view_from_world.right), row(view_from_world.up), row(view_from_world.backward)};
  set_rows();
}

void VertexTransform::set_rows() {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const Ball& entry = matrix_.rows[i][j];
      // Each term meets at most six roundings: the entry (1), the subtraction of the origin (1), the product
      // (1) and the sums (3); to them comes the entry's own error. An entry may have been cut at the end of a
      // double's range.
      const double value = entry.nearest_double();
      const double error = 8 * kUnit * std::fabs(value) + entry.radius() + 0x1p-1073;
      rows_[i].entries[j] = value;
      rows_[i].errors[j] = entry.is_exact_zero() ? 0 : error;
    }
  }
}

bool VertexTransform::apply_in_doubles(Vec3& p, const CoordinateRounder& rounder) const {
  const double x = p.x - origin_.x;
  const double y = p.y - origin_.y;
  const double z = p.z - origin_.z;
  std::array<double, 3> image{};
  bool accepted = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& [m, e] = rows_[i];
    image[i] = m[0] * x + m[1] * y + m[2] * z + m[3];
    // Products below a double's range lose less than 2^-1070 together.
    const double error = e[0] * std::fabs(x) + e[1] * std::fabs(y) + e[2] * std::fabs(z) + e[3] + 0x1p-1070;
    accepted = accepted && rounder.accepts(image[i], error);
  }
  if (accepted) p = {image[0], image[1], image[2]};
  return accepted;
}

void VertexTransform::apply(TriangleBatch& batch, std::size_t index, CoordinateRounder& rounder) const {
  for (std::size_t v = 0; v < 3; ++v) {
    Vec3& p = batch.triangles[index][v];
    if (!apply_in_doubles(p, rounder))
      rounder.set_vertex(batch, index, v, apply_in_balls(matrix_, origin_, p));
  }
}

void VertexTransform::apply(TriangleBatch& batch, CoordinateRounder& rounder) const {
  std::size_t done_count = 0;
  try {
    for (; done_count < batch.size(); ++done_count) apply(batch, done_count, rounder);
  } catch (...) {
    batch.truncate(done_count);
    throw;
  }
}

}  // namespace pipeline
