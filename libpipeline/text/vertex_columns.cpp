#include "libpipeline/text/vertex_columns.h"

namespace pipeline {

AttributeSet AttributeArrays::names() const {
  AttributeSet names;
  for_each_attribute([&](const auto& row) { names.*row.is_there = !(this->*row.array).empty(); });
  names.material = !materials.empty();
  return names;
}

void AttributeArrays::truncate(std::size_t count) {
  for_each_attribute([&](const auto& row) {
    if (auto& array = this->*row.array; !array.empty()) array.resize(count);
  });
  if (!materials.empty()) materials.resize(count);
}

void AttributeArrays::resize(std::size_t count, const AttributeSet& attributes) {
  for_each_attribute([&](const auto& row) {
    if (attributes.*row.is_there) (this->*row.array).resize(count);
  });
  if (attributes.material) materials.resize(count);
}

void AttributeArrays::add(const TriangleLines& lines, const AttributeSet& attributes) {
  const auto& v = lines.vertices;
  for_each_attribute([&](const auto& row) {
    if (attributes.*row.is_there)
      (this->*row.array).push_back({v[0].*row.value, v[1].*row.value, v[2].*row.value});
  });
  if (attributes.material) materials.push_back(lines.material);
}

void AttributeArrays::copy(std::size_t index, ClipTriangle& vertices) const {
  for_each_attribute([&](const auto& row) {
    const auto& array = this->*row.array;
    for (std::size_t v = 0; v < 3 && !array.empty(); ++v) vertices[v].*row.value = array[index][v];
  });
}

}  // namespace pipeline
