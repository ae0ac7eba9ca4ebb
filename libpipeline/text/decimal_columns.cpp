#include "libpipeline/text/fixed_text.h"

#include "libpipeline/text/number_parser.h"
#include "libpipeline/text/number_printer.h"
#include "libpipeline/text/vertex_lines.h"

namespace pipeline {
namespace {

/// Reads three numbers; `separator` follows the last. Null if the form differs.
const char* read_three(const char* p, char separator, Vec3& numbers, unsigned& marks) {
  const auto read = [&](char end, double& value) {
    DecimalNumber number;
    p = read_decimal_number(p, number);
    value = number.value;
    marks = marks >> 1 | (number.decimals <= kExactDecimals ? 4u : 0u);
    return p != nullptr && *p++ == end;
  };
  return read(' ', numbers.x) && read(' ', numbers.y) && read(separator, numbers.z) ? p : nullptr;
}

/// Reads a vertex line; null if the form differs.
const char* read_line(const char* p, const FixedColumns& columns, std::size_t triangle, std::size_t vertex,
                      DecimalMarks& marks) {
  const std::size_t group_count = columns.group_count();
  const bool has_material = !columns.materials.empty();
  for (std::size_t group = 0; group < group_count; ++group) {
    const char end = group + 1 == group_count && !has_material ? '\n' : ' ';
    const bool w_follows = group == 0 && !columns.w.empty();
    unsigned group_marks = 0;
    p = read_three(p, w_follows ? ' ' : end, columns.groups[group][triangle][vertex], group_marks);
    if (p == nullptr) return nullptr;
    if (group == 0) marks = static_cast<DecimalMarks>(marks | group_marks << (3 * vertex));
    if (w_follows && (p = read_w(p, end, columns.w[triangle][vertex])) == nullptr) return nullptr;
  }
  return has_material ? read_material(p, vertex, columns.materials[triangle]) : p;
}

char* write_three(char* out, const Vec3& numbers) {
  for (const double number : {numbers.x, numbers.y, numbers.z}) {
    out = print_shortest(out, number);
    *out++ = ' ';
  }
  return out;
}

}  // namespace

FixedTextPart read_decimal_columns(std::string_view text, TriangleFrame frame, const FixedColumns& columns,
                                   std::span<DecimalMarks> marks) {
  return read_by_lines(text, frame, columns.triangle_count(),
                       [&](const char* p, std::size_t triangle, std::size_t vertex) {
                         if (vertex == 0) marks[triangle] = 0;
                         return read_line(p, columns, triangle, vertex, marks[triangle]);
                       });
}

char* write_shortest_columns(const ConstFixedColumns& columns, char* out) {
  const std::size_t group_count = columns.group_count();
  for (std::size_t i = 0; i < columns.triangle_count(); ++i) {
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
      for (std::size_t group = 0; group < group_count; ++group) {
        out = write_three(out, columns.groups[group][i][vertex]);
        if (group == 0 && !columns.w.empty()) out = write_w(out, columns.w[i][vertex]);
      }
      out = write_line_end(out, columns.materials, i);
    }
    *out++ = '\n';
  }
  return out;
}

std::size_t write_columns(const ConstFixedColumns& columns, NumberFormat format, TextWriter& text) {
  if (!format.shortest && format.decimals > kMaxFixedDecimals) return 0;
  const std::size_t max_length = format.shortest       ? kMaxShortestColumnsLength
                                 : columns.form() == 0 ? kMaxFixedTriangleLength
                                                       : kMaxFixedColumnsLength;
  char* const out = text.reserve(columns.triangle_count() * max_length + kFixedTextSlack);
  FixedTextPart part;
  if (format.shortest)
    part = {columns.triangle_count(), static_cast<std::size_t>(write_shortest_columns(columns, out) - out)};
  else
    part = write_fixed_columns(columns, format.decimals, out);
  text.commit(out + part.length);
  return part.triangle_count;
}

}  // namespace pipeline
