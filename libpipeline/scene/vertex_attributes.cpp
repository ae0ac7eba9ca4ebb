#include "libpipeline/scene/vertex_attributes.h"

#include <algorithm>

#include "libpipeline/scene/header_line.h"

namespace pipeline {
namespace {

double read_channel(LineScanner& line, std::string_view name, std::string_view of) {
  const auto is_in_range = [](double value) { return value >= 0 && value <= 255; };
  return number_where(line, {name, of}, "from 0 to 255", is_in_range);
}

}  // namespace

std::string attributes_line(const AttributeSet& attributes) {
  std::string line = "attributes";
  for (const auto& [name, is_there] : kAttributes)
    if (attributes.*is_there) line.append(" ").append(name);
  return line;
}

std::string column_names(const AttributeSet& attributes) {
  std::string names = "x y z";
  if (attributes.w) names += " w";
  if (attributes.color) names += " r g b";
  if (attributes.normal) names += " nx ny nz";
  if (attributes.material) names += " material";
  if (!attributes.any()) return names;
  // The line that asks for more columns may be far above, in another program's output.
  return names + ", by the line '" + attributes_line(attributes) + "'";
}

Vec3 read_color(LineScanner& line, std::string_view of) {
  Vec3 color;
  color.x = read_channel(line, "the red of ", of);
  color.y = read_channel(line, "the green of ", of);
  color.z = read_channel(line, "the blue of ", of);
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
  values.position.x = line.number("the x of ", name);
  values.position.y = line.number("the y of ", name);
  values.position.z = line.number("the z of ", name);
  if (attributes_.w && range_of_w_ == RangeOfW::any)
    values.w = line.number("the w of ", name);
  else if (attributes_.w)
    values.w = number_where(line, {"the w of ", name}, "above 0", [](double value) { return value > 0; });
  if (attributes_.color) values.color = read_color(line, name);
  if (attributes_.normal) {
    values.normal.x = line.number("the normal's x of ", name);
    values.normal.y = line.number("the normal's y of ", name);
    values.normal.z = line.number("the normal's z of ", name);
  }
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

/// Whether the values of the triangles from `begin` on are in range. In a scene, a normal may not be 0.
bool VertexLineReader::are_in_range(const AttributeArrays& attributes, std::size_t begin,
                                    TriangleFrame frame) const {
  const auto all = [&](const auto& triangles, const auto& is_fine) {
    bool all_are = true;  // without a jump per number
    for (std::size_t i = begin; i < triangles.size(); ++i)
      for (const auto& vertex : triangles[i]) all_are &= is_fine(vertex);
    return all_are;
  };
  const auto is_channel = [](double value) { return (value >= 0) & (value <= 255); };
  const auto is_color = [&](const Vec3& c) { return is_channel(c.x) & is_channel(c.y) & is_channel(c.z); };
  const std::span<const std::uint32_t> materials = attributes.materials;
  const auto is_material = [&](std::uint32_t number) { return number < material_count_; };
  return (!attributes_.material || std::ranges::all_of(materials.subspan(begin), is_material)) &&
         all(attributes.w, [](double w) { return w > 0; }) && all(attributes.colors, is_color) &&
         (frame != TriangleFrame::scene ||
          all(attributes.normals, [](const Vec3& n) { return n != Vec3{}; }));
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

void AttributeArrays::clear() {
  truncate(0);
}

void AttributeArrays::truncate(std::size_t count) {
  if (!w.empty()) w.resize(count);
  if (!colors.empty()) colors.resize(count);
  if (!normals.empty()) normals.resize(count);
  if (!materials.empty()) materials.resize(count);
}

void AttributeArrays::resize(std::size_t count, const AttributeSet& attributes) {
  if (attributes.w) w.resize(count);
  if (attributes.color) colors.resize(count);
  if (attributes.normal) normals.resize(count);
  if (attributes.material) materials.resize(count);
}

void AttributeArrays::add(const TriangleLines& lines, const AttributeSet& attributes) {
  const auto& [a, b, c] = lines.vertices;
  if (attributes.w) w.push_back({a.w, b.w, c.w});
  if (attributes.color) colors.push_back({a.color, b.color, c.color});
  if (attributes.normal) normals.push_back({a.normal, b.normal, c.normal});
  if (attributes.material) materials.push_back(lines.material);
}

}  // namespace pipeline
