#include "libpipeline/raytracing/traced_triangles.h"

#include <algorithm>
#include <cmath>

#include "libpipeline/text/error.h"

namespace pipeline {

void TracedTriangles::add(const TriangleBatch& p_view, const TriangleBatch& p_ndc, const std::string& file) {
  std::size_t image = 0;
  const auto is_image_of = [&](const VertexLocations& triangle) {
    return image < p_ndc.size() && std::ranges::find(triangle, p_ndc.locations[image][0]) != triangle.end();
  };
  AttributeSet columns = p_view.attributes.names();
  columns.w = columns.any();
  for (std::size_t i = 0; i < p_view.size(); ++i) {
    bool is_first = true;
    for (; is_image_of(p_view.locations[i]); is_first = false) {
      add_entry(p_view, i, is_first);
      add_image(p_ndc, image++);
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
      throw InputError({file, sphere.locations[0].line(), sphere.locations[0].column()},
                       expected_but_found("a sphere with a volume", "four points in a plane"));
    spheres_.push_back({*surface, sphere.color, sphere.number, sphere.material});
  }
}

void TracedTriangles::add_entry(const TriangleBatch& p_view, std::size_t index, bool is_first) {
  are_first_.push_back(is_first);
  p_view_.push_back(p_view.triangles[index]);
  numbers_.push_back(p_view.numbers[index]);
  attributes_.add(p_view.attributes, index);
}

void TracedTriangles::add_image(const TriangleBatch& p_ndc, std::size_t index) {
  const std::size_t id = p_ndc_.size();
  // Triangles before it may have left arrays shorter that they had no use for.
  const Triangle& triangle = p_ndc.triangles[index];
  for (const Vec3& p : triangle) largest_depth_ = std::max(largest_depth_, std::fabs(p.z));
  const auto set = [&](auto& array, const auto& value) {
    array.resize(id + 1);
    array[id] = value;
  };
  p_ndc_.triangles.push_back(triangle);
  set(p_ndc_.decimal_marks, p_ndc.decimal_marks[index]);
  if (!p_ndc.low_parts.empty()) set(p_ndc_.low_parts, p_ndc.low_parts[index]);
  if (!p_ndc.unclipped.empty()) set(p_ndc_.unclipped, p_ndc.unclipped[index]);
  p_ndc_.attributes.add(p_ndc.attributes, index);
}

}  // namespace pipeline
