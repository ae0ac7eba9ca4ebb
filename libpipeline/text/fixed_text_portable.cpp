#include <algorithm>
#include <cstdint>

#include "libpipeline/numbers/powers_of_ten.h"
#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/fixed_number.h"
#include "libpipeline/text/vertex_lines.h"
#include "libpipeline/text/number_printer.h"

namespace pipeline {
namespace {

// ---- reading ----

/// How to read numbers with a count of decimals.
struct ReadForm {
  std::size_t decimals;
  std::size_t max_count;  // of digits before the point
  std::size_t
      end;  // the separator's position after that of the point, which it takes if there are no decimals
  unsigned shift;       // moves the decimals, at most eight of them, to the end of a word
  std::uint64_t scale;  // 10 to the power of their count
  double units_per_one;

  constexpr explicit ReadForm(std::size_t count)
      : decimals(count),
        max_count(std::min<std::size_t>(15 - count, 8)),
        end(count > 0 ? count + 1 : 0),
        shift(8 * (8 - static_cast<unsigned>(std::clamp<std::size_t>(count, 1, 8)))),
        scale(kWholePowersOfTen[std::min<std::size_t>(count, 8)]),
        units_per_one(kPowersOfTen[count]) {}
};

/// Reads one number and the separator after it; null if the form differs.
[[gnu::always_inline]] inline const char* read_number(const char* p, const ReadForm& form, char separator,
                                                      double& value) {
  const bool is_negative = *p == '-';
  p += is_negative ? 1 : 0;
  const std::uint64_t before = load_eight(p) - kEightZeros;
  const std::size_t count = leading_digit_count(before);
  if (count - 1 >= form.max_count || p[count + form.end] != separator) return nullptr;
  std::uint64_t units = join_leading_digits(before, count);
  if (form.end > 0) {
    const std::uint64_t behind = (load_eight(p + count + 1) - kEightZeros) << form.shift;
    if (p[count] != '.' || no_digits(behind) != 0) return nullptr;
    units = units * form.scale + join_digits(behind);
  }
  if (form.decimals > 8) {
    const std::size_t more = form.decimals - 8;
    const std::uint64_t behind = load_eight(p + count + 9) - kEightZeros;
    if (leading_digit_count(behind) < more) return nullptr;
    units = units * kWholePowersOfTen[more] + join_leading_digits(behind, more);
  }
  // Below 2^53 the conversion is exact, so the quotient is the nearest double to the decimal.
  const double magnitude = static_cast<double>(units) / form.units_per_one;
  value = is_negative ? -magnitude : magnitude;
  return p + count + form.end + 1;
}

template <TriangleFrame frame>
[[gnu::always_inline]] inline const char* read_triangle(const char* p, const ReadForm& form,
                                                        Triangle& triangle) {
  if ((p = vertex_lines<frame>(p)) == nullptr) return nullptr;
  for (Vec3& vertex : triangle) {
    if ((p = read_number(p, form, ' ', vertex.x)) == nullptr) return nullptr;
    if ((p = read_number(p, form, ' ', vertex.y)) == nullptr) return nullptr;
    if ((p = read_number(p, form, '\n', vertex.z)) == nullptr) return nullptr;
  }
  if constexpr (frame == TriangleFrame::scene) return p;
  return *p == '\n' ? p + 1 : nullptr;
}

template <TriangleFrame frame>
[[gnu::always_inline]] inline FixedTextPart read_triangles(std::string_view text, const ReadForm& form,
                                                           std::span<Triangle> triangles) {
  FixedTextPart part;
  const char* p = text.data();
  const char* const end = p + text.size();
  for (Triangle& triangle : triangles) {
    if (p >= end) break;
    const char* const next = read_triangle<frame>(p, form, triangle);
    if (next == nullptr || next > end) break;
    p = next;
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(p - text.data());
  return part;
}

/// Compiled once more for the seven decimals of nearly all text.
template <TriangleFrame frame>
FixedTextPart read_fixed_text(std::string_view text, int decimals, std::span<Triangle> triangles) {
  if (decimals == 7) return read_triangles<frame>(text, ReadForm(7), triangles);
  return read_triangles<frame>(text, ReadForm(static_cast<std::size_t>(decimals)), triangles);
}

using ReadForms = std::array<ReadForm, 3>;

/// Reads a vertex line; null if the form differs.
const char* read_line(const char* p, const ReadForms& forms, const FixedColumns& columns,
                      std::size_t triangle, std::size_t vertex, LastRead& last) {
  const std::size_t group_count = columns.group_count();
  for (std::size_t group = 0; group < group_count; ++group) {
    if (group == kRepeatedGroup && last.is_at(p)) {
      columns.groups[group][triangle][vertex] = last.numbers();
      p += last.length();
      continue;
    }
    const char* const begin = p;
    const char end = group + 1 == group_count ? '\n' : ' ';
    const bool w_follows = group == 0 && !columns.w.empty();
    auto& [x, y, z] = columns.groups[group][triangle][vertex];
    if ((p = read_number(p, forms[group], ' ', x)) == nullptr) return nullptr;
    if ((p = read_number(p, forms[group], ' ', y)) == nullptr) return nullptr;
    if ((p = read_number(p, forms[group], w_follows ? ' ' : end, z)) == nullptr) return nullptr;
    if (group == kRepeatedGroup) last.set(begin, p, {x, y, z});
    if (w_follows && (p = read_w(p, end, columns.w[triangle][vertex])) == nullptr) return nullptr;
  }
  return p;
}

FixedTextPart read_columns(std::string_view text, TriangleFrame frame, const GroupDecimals& decimals,
                           const FixedColumns& columns) {
  const auto form = [&](std::size_t group) { return ReadForm(static_cast<std::size_t>(decimals[group])); };
  const ReadForms forms = {form(0), form(1), form(2)};
  LastRead last;
  return read_by_lines(text, frame, columns.triangle_count(),
                       [&](const char* p, std::size_t triangle, std::size_t vertex) {
                         return read_line(p, forms, columns, triangle, vertex, last);
                       });
}

// ---- printing ----

/// Seven decimals are those of nearly all text.
char* write_number(char* out, double value, int decimals) {
  return decimals == 7 ? write_fixed<7>(out, value) : print_scaled(out, value, decimals);
}

[[gnu::always_inline]] inline char* write_three(const Vec3& numbers, int decimals, char* out) {
  if ((out = write_number(out, numbers.x, decimals)) == nullptr) return nullptr;
  *out++ = ' ';
  if ((out = write_number(out, numbers.y, decimals)) == nullptr) return nullptr;
  *out++ = ' ';
  return write_number(out, numbers.z, decimals);
}

char* write_triangle(char* out, const Triangle& triangle, int decimals) {
  for (const Vec3& vertex : triangle) {
    if ((out = write_three(vertex, decimals, out)) == nullptr) return nullptr;
    *out++ = '\n';
  }
  *out++ = '\n';
  return out;
}

FixedTextPart write_fixed_text(std::span<const Triangle> triangles, int decimals, char* out) {
  FixedTextPart part;
  char* const begin = out;
  for (const Triangle& triangle : triangles) {
    char* const next = write_triangle(out, triangle, decimals);
    if (next == nullptr) break;
    out = next;
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(out - begin);
  return part;
}

/// Prints a vertex line; null if `write_three` refuses a number.
char* write_line(char* out, const ConstFixedColumns& columns, std::size_t triangle, std::size_t vertex,
                 int decimals, LastPrinted& last) {
  const std::size_t group_count = columns.group_count();
  for (std::size_t group = 0; group < group_count; ++group) {
    const Vec3& numbers = columns.groups[group][triangle][vertex];
    if (group == kRepeatedGroup && last.is_of(numbers)) {
      out = last.print(out);
      continue;
    }
    const char* const begin = out;
    if ((out = write_three(numbers, decimals, out)) == nullptr) return nullptr;
    *out++ = ' ';
    if (group == kRepeatedGroup) last.set(numbers, begin, out);
    if (group == 0 && !columns.w.empty()) out = write_w(out, columns.w[triangle][vertex]);
  }
  out[-1] = '\n';
  return out;
}

FixedTextPart write_columns(const ConstFixedColumns& columns, int decimals, char* out) {
  LastPrinted last;
  FixedTextPart part;
  char* const begin = out;
  for (std::size_t i = 0; i < columns.triangle_count(); ++i) {
    for (std::size_t vertex = 0; vertex < 3; ++vertex)
      if ((out = write_line(out, columns, i, vertex, decimals, last)) == nullptr) return part;
    *out++ = '\n';
    ++part.triangle_count;
    part.length = static_cast<std::size_t>(out - begin);
  }
  return part;
}

}  // namespace

constinit const FixedTextKernel kPortableKernel = {"portable",
                                                   read_fixed_text<TriangleFrame::stage_text>,
                                                   read_fixed_text<TriangleFrame::scene>,
                                                   read_columns,
                                                   write_fixed_text,
                                                   write_columns};

}  // namespace pipeline
