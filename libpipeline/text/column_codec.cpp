#include <algorithm>

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

/// Reads the vertex line at `p` and returns its end; null if the form differs.
[[gnu::always_inline]] inline const char* read_line(const char* p, const FixedColumns& columns,
                                                    std::size_t triangle, std::size_t vertex,
                                                    DecimalMarks& marks) {
  const std::size_t group_count = columns.group_count();
  for (std::size_t group = 0; group < group_count; ++group) {
    const bool has_w = group == 0 && !columns.w.empty();
    const char separator = columns.separator_after(group);
    unsigned group_marks = 0;
    p = read_three(p, has_w ? ' ' : separator, columns.groups[group][triangle][vertex], group_marks);
    if (p == nullptr) return nullptr;
    if (group == 0) marks = static_cast<DecimalMarks>(marks | group_marks << (3 * vertex));
    if (has_w && (p = read_w(p, separator, columns.w[triangle][vertex])) == nullptr) return nullptr;
  }
  return columns.materials.empty() ? p : read_material(p, vertex, columns.materials[triangle]);
}

/// Vertex lines already read, made of groups alone, for triangles that share them; the last line of each hash
/// is kept.
class LinesRead {
 public:
  /// Reads the line at `p`, or copies the numbers of a kept line with the same text.
  const char* read(const char* p, const FixedColumns& columns, std::size_t triangle, std::size_t vertex,
                   std::span<DecimalMarks> marks) {
    constexpr std::uint64_t kMixer = 0x9e3779b97f4a7c15;
    Line& line = lines_[((load_eight(p) * kMixer) ^ load_eight(p + 8)) * kMixer >> 58];
    if (line.length == 0 || std::memcmp(p, line.text, line.length) != 0) {
      const char* const end = read_line(p, columns, triangle, vertex, marks[triangle]);
      if (end != nullptr) line = {p, static_cast<std::size_t>(end - p), triangle, vertex};
      return end;
    }
    for (std::size_t group = 0; group < columns.group_count(); ++group)
      columns.groups[group][triangle][vertex] = columns.groups[group][line.triangle][line.vertex];
    const unsigned marks_of_line = marks[line.triangle] >> (3 * line.vertex) & 7u;
    marks[triangle] = static_cast<DecimalMarks>(marks[triangle] | marks_of_line << (3 * vertex));
    return p + line.length;
  }

 private:
  struct Line {
    const char* text;
    std::size_t length = 0;  // 0: none yet
    std::size_t triangle, vertex;
  };
  std::array<Line, 64> lines_;
};

/// Reads at most `limit` triangles; `read_vertex(p, triangle, vertex)` reads the line at `p` and returns its
/// end, or null.
template <typename ReadVertex>
FixedTextPart read_by_lines(std::string_view text, TriangleFrame frame, std::size_t limit,
                            const ReadVertex& read_vertex) {
  const char* const end = text.data() + text.size();
  FixedTextPart part;
  for (std::size_t i = 0; i < limit && part.length < text.size(); ++i) {
    const char* p = vertex_lines(text.data() + part.length, frame);
    for (std::size_t vertex = 0; vertex < 3 && p != nullptr; ++vertex)
      p = p < end ? read_vertex(p, i, vertex) : nullptr;
    if (p == nullptr || (p = triangle_end(p, frame)) == nullptr || p > end) break;
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(p - text.data());
  }
  return part;
}

/// Reads triangles number by number.
FixedTextPart read_by_numbers(std::string_view text, TriangleFrame frame, const FixedColumns& columns,
                              std::span<DecimalMarks> marks) {
  const std::size_t limit = std::min(columns.triangle_count(), marks.size());
  std::ranges::fill(marks.first(limit), DecimalMarks{0});
  // Lines recur in models, which have normals. A line with only a position is read faster than found.
  if (frame != TriangleFrame::scene || columns.group_count() == 1 || !columns.has_groups_alone())
    return read_by_lines(text, frame, limit, [&](const char* p, std::size_t triangle, std::size_t vertex) {
      return read_line(p, columns, triangle, vertex, marks[triangle]);
    });
  LinesRead lines;
  return read_by_lines(text, frame, limit, [&](const char* p, std::size_t triangle, std::size_t vertex) {
    return lines.read(p, columns, triangle, vertex, marks);
  });
}

/// The counts of decimals of the groups on the first vertex line of `text`.
GroupDecimals decimals_of_groups(std::string_view text, const FixedColumns& columns) {
  GroupDecimals decimals = {decimals_of_number(text.data())};
  for (std::size_t group = 1; group < columns.group_count(); ++group) {
    for (int words = group == 1 && !columns.w.empty() ? 4 : 3; words > 0; --words)
      text.remove_prefix(std::min(text.find(' '), text.size() - 1) + 1);
    decimals[group] = decimals_of_number(text.data());
  }
  return decimals;
}

/// Prints a triangle number by number.
char* write_triangle(char* out, const ConstFixedColumns& columns, std::size_t triangle,
                     const Triangle& low_part, NumberFormat format) {
  const std::size_t group_count = columns.group_count();
  for (std::size_t vertex = 0; vertex < 3; ++vertex) {
    out = print_three(out, columns.groups[0][triangle][vertex], low_part[vertex], format);
    if (!columns.w.empty()) {
      out = print_shortest(out, columns.w[triangle][vertex]);
      *out++ = ' ';
    }
    for (std::size_t group = 1; group < group_count; ++group)
      out = print_three(out, columns.groups[group][triangle][vertex], {}, format);
    out = write_line_end(out, columns.materials, triangle);
  }
  *out++ = '\n';
  return out;
}

}  // namespace

FixedTextPart read_columns(std::string_view text, TriangleFrame frame, const FixedColumns& columns,
                           std::span<DecimalMarks> marks) {
  const char *const lines = vertex_lines(text.data(), frame), *const end = text.data() + text.size();
  if (lines == nullptr || lines > end) return {};
  const GroupDecimals decimals = decimals_of_groups({lines, end}, columns);
  FixedTextPart part = fixed_readers()[columns.form()](text, frame, decimals, columns);
  if (part.triangle_count == 0) return read_by_numbers(text, frame, columns, marks);
  part.decimals = decimals[0];
  return part;
}

void write_columns(const ConstFixedColumns& columns, const Triangle* low_part, NumberFormat format,
                   TextWriter& text) {
  static const WriteFixedColumns write_fixed = chosen_kernel(kFixedPrintingKernels);
  static constexpr Triangle kNothing = {};
  constexpr std::size_t kMaxShortestLength = 24;
  constexpr std::size_t kNumbers = 3 * (3 * kMaxGroups + 2);
  const std::size_t max_fixed_length = columns.form() == 0 ? kMaxFixedTriangleLength : kMaxFixedColumnsLength;
  const std::size_t max_length =
      kNumbers * ((format.shortest ? kMaxShortestLength : kMaxNumberLength) + 1) + 1;
  const std::size_t count = columns.triangle_count();
  const bool is_fixed = !format.shortest && format.decimals <= kMaxFixedDecimals &&
                        (low_part == nullptr || *low_part == Triangle{});
  for (std::size_t i = 0; i < count;) {
    std::size_t end = count;
    if (is_fixed) {
      char* const out = text.reserve((count - i) * max_fixed_length + kFixedTextSlack);
      const FixedTextPart part = write_fixed(columns, i, format.decimals, out);
      text.commit(out + part.length);
      i += part.triangle_count;
      if (i == count) return;
      end = part.triangle_count > 0 ? i + 1 : std::min(count, i + 8);  // after two misses, more follow
    }
    char* out = text.reserve((end - i) * max_length + kFixedTextSlack);
    for (; i < end; ++i)
      out = write_triangle(out, columns, i, low_part == nullptr ? kNothing : *low_part, format);
    text.commit(out);
  }
}

}  // namespace pipeline
