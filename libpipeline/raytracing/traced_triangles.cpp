#include "libpipeline/raytracing/traced_triangles.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "libpipeline/scene/color.h"
#include "libpipeline/text/error.h"
#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

/// True if the text of `value` is a decimal in exact arithmetic; `low_part` is decimal - double.
bool is_decimal(double value, double& low_part) {
  // In this range, the shortest form has no exponent, and is n / 10^7 if such a quotient is the double
  // (print_shortest).
  constexpr double kScale = 1e7;
  const double size = std::fabs(value);
  if (size >= 0.001 && size < 1e5) return std::nearbyint(size * kScale) / kScale == size;
  char text[kMaxNumberLength];
  DoubleDouble decimal;
  if (!parse_exact_decimal({text, print_shortest(text, value)}, decimal)) return false;
  low_part = decimal.lo;
  return true;
}

}  // namespace

void pass_through_text(TriangleBatch& batch) {
  constexpr double kNoMinus = 0;
  batch.decimal_marks.resize(batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    Triangle low_parts;
    unsigned marks = 0;
    for (std::size_t v = 0; v < 3; ++v) {
      Vec3& p = batch.triangles[i][v];
      p = {p.x + kNoMinus, p.y + kNoMinus, p.z + kNoMinus};
      if (is_decimal(p.x, low_parts[v].x)) marks |= 1u << (3 * v);
      if (is_decimal(p.y, low_parts[v].y)) marks |= 2u << (3 * v);
    }
    batch.decimal_marks[i] = static_cast<std::uint16_t>(marks);
    if (low_parts == Triangle{} && batch.low_parts.empty()) continue;
    batch.low_parts.resize(batch.size());
    batch.low_parts[i] = low_parts;
  }
}

const TriangleBatch& TracedTriangles::add(const TriangleBatch& p_view) {
  stage_.project(p_view, projected_);
  pass_through_text(projected_);
  std::size_t image = 0;
  const auto is_image_of = [&](const VertexLocations& triangle) {
    return image < projected_.size() &&
           std::ranges::find(triangle, projected_.locations[image][0]) != triangle.end();
  };
  AttributeSet columns = p_view.attributes.names();
  columns.w = columns.any();
  for (std::size_t i = 0; i < p_view.size(); ++i) {
    bool is_first = true;
    for (; is_image_of(p_view.locations[i]); is_first = false) {
      add_entry(p_view, i, is_first);
      add_image(image++);
    }
    if (!is_first || !keeps_dropped_) continue;
    add_entry(p_view, i, true);
    p_ndc_.triangles.emplace_back();
    p_ndc_.attributes.resize(p_ndc_.size(), columns);
  }
  p_ndc_.decimal_marks.resize(p_ndc_.size());
  if (!p_ndc_.low_parts.empty()) p_ndc_.low_parts.resize(p_ndc_.size());
  if (!p_ndc_.unclipped.empty()) p_ndc_.unclipped.resize(p_ndc_.size());
  for (const Sphere& sphere : p_view.spheres) {
    const std::optional<Ellipsoid> surface = Ellipsoid::from(sphere.points);
    if (!surface)
      throw InputError({file_, sphere.locations[0].line(), sphere.locations[0].column()},
                       "a sphere with a volume", "four points in a plane");
    const Vec3 color = sphere.color.value_or(to_vec3(TriangleColors().of(sphere.number)));
    spheres_.push_back({*surface, color, sphere.number, sphere.material});
  }
  return projected_;
}

void TracedTriangles::add_entry(const TriangleBatch& p_view, std::size_t index, bool is_first) {
  are_first_.push_back(is_first);
  p_view_.push_back(p_view.triangles[index]);
  numbers_.push_back(p_view.numbers[index]);
  attributes_.add(p_view.attributes, index);
}

void TracedTriangles::add_image(std::size_t index) {
  const Triangle& triangle = projected_.triangles[index];
  for (const Vec3& p : triangle) largest_depth_ = std::max(largest_depth_, std::fabs(p.z));
  p_ndc_.triangles.push_back(triangle);
  // An array may be shorter if earlier triangles did not need it.
  const auto add = [&](auto& array, const auto& from) {
    if (from.empty()) return;
    array.resize(p_ndc_.size());
    array.back() = from[index];
  };
  add(p_ndc_.decimal_marks, projected_.decimal_marks);
  add(p_ndc_.low_parts, projected_.low_parts);
  add(p_ndc_.unclipped, projected_.unclipped);
  p_ndc_.attributes.add(projected_.attributes, index);
}

}  // namespace pipeline
