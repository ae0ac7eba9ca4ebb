#include "libpipeline/scene/vertex_attributes.h"

#include <algorithm>

#include "libpipeline/scene/header_line.h"
#include "libpipeline/text/fixed_text.h"

namespace pipeline {
namespace {

/// Takes the numbers of an attribute; their range is checked only if `has_range`.
template <typename Value>
void read_value(LineScanner& line, const VertexAttribute<Value>& attribute, bool has_range,
                std::string_view of, Value& value) {
  const auto numbers = numbers_of(value);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    *numbers[i] = attribute.range.empty() || !has_range
                      ? line.number(attribute.each[i], of)
                      : number_where(
                            line, attribute.each[i], attribute.range,
                            [&](double number) { return attribute.is_in_range(number); }, of);
}

}  // namespace

std::string attributes_line(const AttributeSet& attributes) {
  std::string line = "attributes";
  for_each_attribute([&](const auto& attribute) {
    if (attributes.*attribute.is_there) line.append(" ").append(attribute.name);
  });
  return attributes.material ? line + " material" : line;
}

std::string column_names(const AttributeSet& attributes) {
  std::string names = "x y z";
  for_each_attribute([&](const auto& attribute) {
    if (attributes.*attribute.is_there) names.append(" ").append(attribute.columns);
  });
  if (attributes.material) names += " material";
  if (!attributes.any()) return names;
  // The line that asks for more columns may be far above, in another program's output.
  return names + ", by the line '" + attributes_line(attributes) + "'";
}

Vec3 read_color(LineScanner& line, std::string_view of) {
  Vec3 color;
  read_value(line, kColor, true, of, color);
  return color;
}

VertexLineReader::VertexLineReader(const AttributeSet& attributes, RangeOfW range_of_w,
                                   std::size_t material_count)
    : attributes_(attributes), range_of_w_(range_of_w), material_count_(material_count) {
  for (std::size_t i = 0; i < names_.size(); ++i)
    names_[i] = "vertex " + std::to_string(i + 1) + " of 3 (" + column_names(attributes) + ")";
}

void VertexLineReader::read(LineScanner& line, std::size_t vertex, const std::string& name,
                            TriangleLines& triangle) const {
  VertexLine& values = triangle.vertices[vertex];
  values.position = line.point(name);
  for_each_attribute([&](const auto& attribute) {
    if (!(attributes_.*attribute.is_there)) return;
    const bool has_range = attribute.name != kW.name || range_of_w_ == RangeOfW::above_zero;
    read_value(line, attribute, has_range, name, values.*attribute.value);
  });
  if (attributes_.material) read_material(line, vertex, name, triangle);
  line.expect_end(name);
}

void VertexLineReader::read_material(LineScanner& line, std::size_t vertex, const std::string& name,
                                     TriangleLines& triangle) const {
  const LineScanner at_material = line;
  const std::string expected =
      "the material of " + name + ", a whole number below " + std::to_string(material_count_);
  const std::uint64_t material = line.count(expected);
  if (material >= material_count_) at_material.fail(expected);
  if (vertex == 0) triangle.material = static_cast<std::uint32_t>(material);
  if (material != triangle.material)
    at_material.fail("the material of the triangle's first vertex, " + std::to_string(triangle.material));
}

/// True if the values of the triangles from `begin` on are in range. In a scene, no normal may be 0.
bool VertexLineReader::are_in_range(const AttributeArrays& attributes, std::size_t begin,
                                    TriangleFrame frame) const {
  bool all_are = true;  // without a jump per number
  for_each_attribute([&](const auto& attribute) {
    if (attribute.range.empty()) return;
    const auto& triangles = attributes.*attribute.array;
    for (std::size_t i = begin; i < triangles.size(); ++i)
      for (auto vertex : triangles[i])
        for (const double* number : numbers_of(vertex)) all_are &= attribute.is_in_range(*number);
  });
  const auto is_one = [&](std::uint32_t material) { return material < material_count_; };
  const auto have_length = [](const Triangle& normals) { return !std::ranges::count(normals, Vec3()); };
  const auto all = [&](const auto& array, const auto& is_fine) {
    return array.size() <= begin || std::ranges::all_of(std::span(array).subspan(begin), is_fine);
  };
  return all_are && all(attributes.materials, is_one) &&
         (frame != TriangleFrame::scene || all(attributes.normals, have_length));
}

FixedTextPart VertexLineReader::read_triangles(std::string_view text, TriangleFrame frame, std::size_t limit,
                                               std::span<DecimalMarks> marks,
                                               std::vector<Triangle>& positions,
                                               AttributeArrays& attributes) const {
  const std::size_t old_size = positions.size();
  const auto resize = [&](std::size_t size) {
    positions.resize(size);
    attributes.resize(size, attributes_);
  };
  resize(old_size + limit);
  FixedTextPart part =
      read_columns(text, frame, fixed_columns(positions, attributes, attributes_, old_size, limit), marks);
  resize(old_size + part.triangle_count);
  if (attributes_.any() && !are_in_range(attributes, old_size, frame)) {
    part = {};
    resize(old_size);
  }
  return part;
}

}  // namespace pipeline
