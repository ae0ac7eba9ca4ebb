#include "libpipeline/stream/sphere_reader.h"

#include <algorithm>
#include <string_view>

#include "libpipeline/stream/triangle_reader.h"

namespace pipeline {
namespace {

AttributeSet without_normal(AttributeSet columns) {
  columns.normal = false;
  return columns;
}

}  // namespace

SphereReader::SphereReader(TextReader& text, const AttributeSet& columns, std::size_t material_count)
    : text_(text),
      columns_(columns),
      point_line_(without_normal(columns), RangeOfW::above_zero, material_count) {
  constexpr std::array<std::string_view, 4> kPoints = {"the center", "the center + r i", "the center + r j",
                                                       "the center + r k"};
  for (std::size_t i = 0; i < names_.size(); ++i)
    names_[i] = std::string(kPoints[i]) + " of a sphere (" + column_names(point_line_.attributes()) + ")";
}

void SphereReader::read(LineScanner& line, std::uint64_t number, bool keeps_text, TriangleBatch& batch) {
  line.word();
  line.expect_end("'sphere'");
  if (keeps_text) batch.texts.add_line("sphere");
  SpherePoints points;
  std::array<LineAndColumn, 4> locations;
  TriangleLines lines;
  for (std::size_t i = 0; i < points.size(); ++i) {
    next_line_within("a sphere", text_, line, names_[i]);
    locations[i] = {line.line_number(), line.column()};
    if (keeps_text) batch.texts.add_line(line.rest());
    LineScanner at_columns = line;
    point_line_.read(line, std::min<std::size_t>(i, 1), names_[i], lines);
    const auto& [center, point, unused] = lines.vertices;
    points[i] = i == 0 ? center.position : point.position;
    if (i == 0 || point.color == center.color) continue;
    for (int column = 0; column < 3; ++column) at_columns.word();
    at_columns.fail("the color of the sphere's center");
  }
  batch.add_sphere(points, number, locations);
  lines.vertices.fill(lines.vertices[0]);
  for (int entry = 0; entry < 2; ++entry) batch.attributes.add(lines, columns_);
  if (!keeps_text) return;
  batch.texts.end_triangle();
  batch.texts.end_without_lines();
}

InputError refused_sphere(const SourceLocation& location) {
  return {location,
          expected_but_found("triangles alone",
                             "a sphere: trace draws it, and model --facets N makes triangles of it")};
}

}  // namespace pipeline
