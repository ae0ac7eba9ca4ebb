#include "libpipeline/text/fixed_text.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "libpipeline/numbers/powers_of_ten.h"
#include "libpipeline/text/eight_digits.h"
#include "libpipeline/text/vertex_lines.h"

namespace pipeline {
namespace {

/// How to read numbers with a count of decimals.
struct ReadForm {
  std::size_t decimals;
  std::size_t max_count;  // of digits before the point
  std::size_t
      end;  // the separator's position after that of the point, which it takes if there are no decimals
  unsigned shift;       // moves the decimals, at most eight of them, to the end of a word
  std::uint64_t scale;  // 10 to the power of their count
  double units_per_one;
  // With one digit before the point: how to move it and up to seven decimals to the end of a word, and the
  // other decimals to the end of another.
  unsigned first_shift;
  unsigned rest_shift;
  std::uint64_t rest_scale;  // 10 to the power of their count

  constexpr explicit ReadForm(std::size_t count)
      : decimals(count),
        max_count(std::min<std::size_t>(15 - count, 8)),
        end(count > 0 ? count + 1 : 0),
        shift(8 * (8 - static_cast<unsigned>(std::clamp<std::size_t>(count, 1, 8)))),
        scale(kWholePowersOfTen[std::min<std::size_t>(count, 8)]),
        units_per_one(kPowersOfTen[count]),
        first_shift(8 * (7 - static_cast<unsigned>(std::min<std::size_t>(count, 7)))),
        rest_shift(count > 7 ? 8 * (15 - static_cast<unsigned>(count)) : 0),
        rest_scale(kWholePowersOfTen[count > 7 ? count - 7 : 0]) {}
};

/// Whether numbers have one digit before the point. Where the last ones had, a branch lets the
/// processor go ahead to the next number, whose beginning would otherwise depend on this one; where they had
/// not, it would often go astray.
class OneDigit {
 public:
  [[nodiscard]] bool is_expected() const { return is_expected_; }
  void found(bool has_one) { have_one_ &= has_one; }
  /// Expects of the next numbers what was found since the last call.
  void begin() {
    is_expected_ = have_one_;
    have_one_ = true;
  }

 private:
  bool is_expected_ = true;
  bool have_one_ = true;
};

/// Reads one number and the separator after it; null if the form differs.
[[gnu::always_inline]] inline const char* read_number(const char* p, const ReadForm& form, char separator,
                                                      OneDigit& one_digit, double& value) {
  const bool is_negative = *p == '-';
  p += is_negative ? 1 : 0;
  std::uint64_t units = 0;
  std::size_t count = 1;
  if (one_digit.is_expected() && p[1] == '.' && form.end > 0) {
    // The digit takes the point's place in the word behind it.
    const std::uint64_t text = load_eight(p + 1) + static_cast<std::uint64_t>(*p - '.');
    const std::uint64_t first = (text - kEightZeros) << form.first_shift;
    if (no_digits(first) != 0 || p[1 + form.end] != separator) return nullptr;
    units = join_digits(first);
    if (form.decimals > 7) {
      const std::uint64_t rest = (load_eight(p + 9) - kEightZeros) << form.rest_shift;
      if (no_digits(rest) != 0) return nullptr;
      units = units * form.rest_scale + join_digits(rest);
    }
  } else {
    const std::uint64_t before = load_eight(p) - kEightZeros;
    count = leading_digit_count(before);
    one_digit.found(count == 1);
    if (count - 1 >= form.max_count || p[count + form.end] != separator) return nullptr;
    units = join_leading_digits(before, count);
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
  }
  // Below 2^53 the conversion is exact, so the quotient is the nearest double to the decimal.
  const double magnitude = static_cast<double>(static_cast<std::int64_t>(units)) / form.units_per_one;
  value = is_negative ? -magnitude : magnitude;
  return p + count + form.end + 1;
}

template <TriangleFrame frame>
[[gnu::always_inline]] inline const char* read_triangle(const char* p, const ReadForm& form,
                                                        OneDigit& one_digit, Triangle& triangle) {
  one_digit.begin();
  if ((p = vertex_lines<frame>(p)) == nullptr) return nullptr;
  for (Vec3& vertex : triangle) {
    if ((p = read_number(p, form, ' ', one_digit, vertex.x)) == nullptr) return nullptr;
    if ((p = read_number(p, form, ' ', one_digit, vertex.y)) == nullptr) return nullptr;
    if ((p = read_number(p, form, '\n', one_digit, vertex.z)) == nullptr) return nullptr;
  }
  if constexpr (frame == TriangleFrame::scene) return p;
  return *p == '\n' ? p + 1 : nullptr;
}

template <TriangleFrame frame>
[[gnu::always_inline]] inline FixedTextPart read_triangles(std::string_view text, const ReadForm& form,
                                                           std::span<Triangle> triangles) {
  OneDigit one_digit;
  FixedTextPart part;
  const char* p = text.data();
  const char* const end = p + text.size();
  for (Triangle& triangle : triangles) {
    if (p >= end) break;
    const char* const next = read_triangle<frame>(p, form, one_digit, triangle);
    if (next == nullptr || next > end) break;
    p = next;
    ++part.triangle_count;
  }
  part.length = static_cast<std::size_t>(p - text.data());
  return part;
}

/// Compiled once more for the seven decimals of nearly all text.
template <TriangleFrame frame>
FixedTextPart read_framed(std::string_view text, int decimals, std::span<Triangle> triangles) {
  if (decimals == 7) return read_triangles<frame>(text, ReadForm(7), triangles);
  return read_triangles<frame>(text, ReadForm(static_cast<std::size_t>(decimals)), triangles);
}

using ReadForms = std::array<ReadForm, 3>;

/// What vertex lines have in common with the one before.
struct LineState {
  LastRead last;
  std::array<OneDigit, 3> one_digit;  // of each group
};

/// Reads a vertex line; null if the form differs.
const char* read_line(const char* p, const ReadForms& forms, const FixedColumns& columns,
                      std::size_t triangle, std::size_t vertex, LineState& state) {
  const std::size_t group_count = columns.group_count();
  for (std::size_t group = 0; group < group_count; ++group) {
    if (group == kRepeatedGroup && state.last.is_at(p)) {
      columns.groups[group][triangle][vertex] = state.last.numbers();
      p += state.last.length();
      continue;
    }
    state.one_digit[group].begin();
    const char* const begin = p;
    const char end = group + 1 == group_count ? '\n' : ' ';
    const bool w_follows = group == 0 && !columns.w.empty();
    auto& [x, y, z] = columns.groups[group][triangle][vertex];
    if ((p = read_number(p, forms[group], ' ', state.one_digit[group], x)) == nullptr) return nullptr;
    if ((p = read_number(p, forms[group], ' ', state.one_digit[group], y)) == nullptr) return nullptr;
    if ((p = read_number(p, forms[group], w_follows ? ' ' : end, state.one_digit[group], z)) == nullptr)
      return nullptr;
    if (group == kRepeatedGroup) state.last.set(begin, p, {x, y, z});
    if (w_follows && (p = read_w(p, end, columns.w[triangle][vertex])) == nullptr) return nullptr;
  }
  return p;
}

}  // namespace

int decimals_of_number(const char* p) {
  const auto digit_count = [](const char* from) {
    return leading_digit_count(load_eight(from) - kEightZeros);
  };
  if (*p == '-') ++p;
  p += digit_count(p);
  if (*p != '.') return 0;
  const std::size_t count = digit_count(p + 1);
  return std::min(static_cast<int>(count == 8 ? count + digit_count(p + 9) : count), kMaxFixedDecimals);
}

FixedTextPart read_fixed_text(std::string_view text, int decimals, std::span<Triangle> triangles) {
  return read_framed<TriangleFrame::stage_text>(text, decimals, triangles);
}

FixedTextPart read_fixed_scene(std::string_view text, int decimals, std::span<Triangle> triangles) {
  return read_framed<TriangleFrame::scene>(text, decimals, triangles);
}

FixedTextPart read_fixed_columns(std::string_view text, TriangleFrame frame, const GroupDecimals& decimals,
                                 const FixedColumns& columns) {
  const auto form = [&](std::size_t group) { return ReadForm(static_cast<std::size_t>(decimals[group])); };
  const ReadForms forms = {form(0), form(1), form(2)};
  LineState state;
  return read_by_lines(text, frame, columns.triangle_count(),
                       [&](const char* p, std::size_t triangle, std::size_t vertex) {
                         return read_line(p, forms, columns, triangle, vertex, state);
                       });
}

}  // namespace pipeline
