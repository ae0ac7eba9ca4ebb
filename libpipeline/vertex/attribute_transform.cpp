#include "libpipeline/vertex/attribute_transform.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "libpipeline/numbers/vec_math.h"
#include "libpipeline/text/number_rounding.h"
#include "libpipeline/vertex/vertex_kernel.h"

namespace pipeline {
namespace {

Vec3 nearest(const BallVec3& v) {
  return {v.x.nearest_double(), v.y.nearest_double(), v.z.nearest_double()};
}

BallVec3 linear_row(const std::array<Ball, 4>& row) {
  return {row[0], row[1], row[2]};
}

/// The exponent of two of a number that is not 0.
std::int64_t exponent_of(const Ball& x) {
  return std::ilogb(x.value().hi) + x.exponent();
}

/// Divides vectors by a power of two that brings their largest entry into [1, 2); false if all are 0.
bool scale_to_1(std::span<BallVec3> vectors) {
  std::optional<std::int64_t> exponent;
  for (const BallVec3& v : vectors)
    for (const Ball& entry : {v.x, v.y, v.z})
      if (entry.sign() != 0) exponent = std::max(exponent.value_or(exponent_of(entry)), exponent_of(entry));
  if (!exponent) return false;
  for (BallVec3& v : vectors)
    for (Ball* entry : {&v.x, &v.y, &v.z})
      *entry = Ball::with_error(entry->value(), entry->error(), entry->exponent() - *exponent);
  return true;
}

Located<Light> moved_to(const Located<Light>& light, const BallVec3& position, UncertainDigits& uncertain) {
  const PrintablePoint p = round_to_text(position, kShortest, size_of(light.value.position));
  if (p.overflow != 0)
    throw InputError(light.location, "a light whose image is within a double's range",
                     std::string("an overflow of its ") + p.overflow);
  if (!p.is_certain) uncertain.add(LineAndColumn(light.location.line, light.location.column));
  return {{p.hi, light.value.intensity}, light.location};
}

}  // namespace

NormalTransform::NormalTransform(const ViewTransform& view_from_world)
    : rows_{nearest(view_from_world.right), nearest(view_from_world.up), nearest(view_from_world.backward)} {}

NormalTransform::NormalTransform(const AffineMatrix& world_from_model) {
  const auto& rows = world_from_model.rows;
  const BallVec3 x = linear_row(rows[0]), y = linear_row(rows[1]), z = linear_row(rows[2]);
  // Row i is the cross product of the other two rows of M, in cyclic order.
  std::array<BallVec3, 3> cofactors = {cross(y, z), cross(z, x), cross(x, y)};
  // Else M flattens space to a line, in which no normal has a direction: all rows are 0.
  if (!scale_to_1(cofactors)) return;
  double largest = 0;
  for (const BallVec3& row : cofactors)
    for (const Ball& entry : {row.x, row.y, row.z})
      if (entry.sign() != 0) largest = std::max(largest, entry.magnitude());
  const Ball divisor(world_from_model.orientation < 0 ? -largest : largest);
  for (std::size_t i = 0; i < 3; ++i) {
    ball_rows_[i] = {cofactors[i].x / divisor, cofactors[i].y / divisor, cofactors[i].z / divisor};
    rows_[i] = nearest(ball_rows_[i]);
  }
  determinant_ = dot(rows_[0], cross(rows_[1], rows_[2]));
}

// M7
Vec3 NormalTransform::operator()(const Vec3& normal) const {
  const Vec3 n = unit_vector(normal);
  const Vec3 image = {dot(rows_[0], n), dot(rows_[1], n), dot(rows_[2], n)};
  return largest_in(image) < kNearlyLost ? image_in_balls(to_balls(normal)) : unit_vector(image);
}

void NormalTransform::apply(AttributeArrays& attributes, std::size_t begin, std::size_t end) const {
  for_each_attribute([&]<typename Value>(const VertexAttribute<Value>& attribute) {
    auto& array = attributes.*attribute.array;
    const std::size_t last = std::min(end, array.size());
    if constexpr (std::is_same_v<Value, Vec3>)
      if (attribute.turns_as_normal && begin < last) apply({array[begin].data(), 3 * (last - begin)});
  });
}

void NormalTransform::apply(std::span<Vec3> normals) const {
  while (!normals.empty()) {
    normals = normals.subspan(vertex_kernel().transform_normals(rows_, normals));
    if (normals.empty()) return;
    normals.front() = (*this)(normals.front());
    normals = normals.subspan(1);
  }
}

Vec3 NormalTransform::image_in_balls(const BallVec3& n) const {
  BallVec3 image = {dot(ball_rows_[0], n), dot(ball_rows_[1], n), dot(ball_rows_[2], n)};
  if (!scale_to_1({&image, 1})) return {};
  const double error = std::max({image.x.radius(), image.y.radius(), image.z.radius()});
  return error < 0x1p-24 ? unit_vector(nearest(image)) : Vec3{};
}

Located<Light> transformed(const AffineMatrix& world_from_model, const Located<Light>& light,
                           UncertainDigits& uncertain) {
  const BallVec3 p = to_balls(light.value.position);
  const auto image = [&](const std::array<Ball, 4>& row) { return dot(linear_row(row), p) + row[3]; };
  const auto& rows = world_from_model.rows;
  return moved_to(light, {image(rows[0]), image(rows[1]), image(rows[2])}, uncertain);
}

Located<Light> transformed(const ViewTransform& view, const Located<Light>& light,
                           UncertainDigits& uncertain) {
  const BallVec3 p = to_balls(light.value.position) - to_balls(view.eye);
  return moved_to(light, {dot(view.right, p), dot(view.up, p), dot(view.backward, p)}, uncertain);
}

}  // namespace pipeline
