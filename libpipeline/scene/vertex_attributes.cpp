#include "libpipeline/scene/vertex_attributes.h"

#include <algorithm>
#include <cassert>

#include "libpipeline/scene/header_line.h"
#include "libpipeline/text/fixed_text.h"

namespace pipeline {
namespace {

/// The number of blanks and tabs at `p`; another character must follow.
std::size_t blanks_at(const char* p) {
  std::size_t count = 0;
  while (p[count] == ' ' || p[count] == '\t') ++count;
  return count;
}

double read_channel(LineScanner& line, std::string_view name, std::string_view of) {
  const auto is_in_range = [](double value) { return value >= 0 && value <= 255; };
  return number_where(line, {name, of}, "from 0 to 255", is_in_range);
}

}  // namespace

std::string column_names(const AttributeSet& attributes) {
  std::string names = "x y z";
  if (attributes.w) names += " w";
  if (attributes.color) names += " r g b";
  if (attributes.normal) names += " nx ny nz";
  return names;
}

Vec3 read_color(LineScanner& line, std::string_view of) {
  Vec3 color;
  color.x = read_channel(line, "the red of ", of);
  color.y = read_channel(line, "the green of ", of);
  color.z = read_channel(line, "the blue of ", of);
  return color;
}

VertexLine to_vertex_line(const DecimalVertexLine& line, const AttributeSet& attributes) {
  const auto* next = line.numbers.data();
  const auto vec3 = [&] {
    const Vec3 v = {next[0].value, next[1].value, next[2].value};
    next += 3;
    return v;
  };
  VertexLine vertex;
  vertex.position = vec3();
  if (attributes.w) vertex.w = next++->value;
  if (attributes.color) vertex.color = vec3();
  if (attributes.normal) vertex.normal = vec3();
  return vertex;
}

VertexLineReader::VertexLineReader(const AttributeSet& attributes, RangeOfW range_of_w)
    : attributes_(attributes),
      range_of_w_(range_of_w),
      column_count_(std::size_t{3} + (attributes.w ? 1 : 0) + (attributes.color ? 3 : 0) +
                    (attributes.normal ? 3 : 0)) {
  for (std::size_t i = 0; i < names_.size(); ++i)
    names_[i] = "vertex " + std::to_string(i + 1) + " of 3 (" + column_names(attributes) + ")";
}

VertexLine VertexLineReader::read(LineScanner& line, std::size_t vertex) const {
  const std::string& name = names_[vertex];
  VertexLine values;
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
  line.expect_end(name);
  return values;
}

bool VertexLineReader::are_in_range(std::span<const DecimalNumber> columns) const {
  const auto after_position = columns.subspan(3);
  if (attributes_.w && !(after_position[0].value > 0)) return false;
  if (!attributes_.color) return true;
  const auto color = after_position.subspan(attributes_.w ? 1 : 0, 3);
  return std::all_of(color.begin(), color.end(),
                     [](const DecimalNumber& channel) { return channel.value >= 0 && channel.value <= 255; });
}

/// Reads a line in fixed form (fixed_text.h), but for w. Three numbers each have the same decimals, and those
/// that `numbers` had before: usually the ones of the last triangle.
const char* VertexLineReader::read_fixed_line(const char* p, std::span<DecimalNumber> numbers) const {
  std::size_t column = 0;
  const auto separator = [&] { return column == column_count_ ? '\n' : ' '; };
  while (column < column_count_) {
    const auto next = numbers.subspan(column);
    if (attributes_.w && column == 3) {
      ++column;
      p = read_decimal_number(p, next[0]);
      if (p == nullptr || *p++ != separator()) return nullptr;
    } else {
      column += 3;
      Vec3 values;
      const int decimals = next[0].decimals;
      const bool may_be_fixed = decimals == next[1].decimals && decimals == next[2].decimals;
      if (!may_be_fixed || decimals > kMaxFixedDecimals) return nullptr;
      p = fixed_text_kernel().read_three(p, decimals, separator(), values);
      if (p == nullptr) return nullptr;
      next[0] = {values.x, decimals};
      next[1] = {values.y, decimals};
      next[2] = {values.z, decimals};
    }
  }
  return p;
}

const char* VertexLineReader::read_decimals(const char* p, const char* end,
                                            DecimalVertexLines& vertices) const {
  for (DecimalVertexLine& line : vertices) {
    const auto taken = std::span(line.numbers).first(column_count_);
    assert(p != nullptr);
    const char* const begin = p;
    p = read_fixed_line(p, taken);
    if (p == nullptr || p > end) p = read_decimal_line(begin, end, taken);
    if (p == nullptr || !are_in_range(taken)) return nullptr;
    line.indent = blanks_at(begin);
  }
  return p;
}

void AttributeArrays::clear() {
  truncate(0);
}

void AttributeArrays::truncate(std::size_t count) {
  if (!w.empty()) w.resize(count);
  if (!colors.empty()) colors.resize(count);
  if (!normals.empty()) normals.resize(count);
}

void AttributeArrays::add(const std::array<VertexLine, 3>& vertices, const AttributeSet& attributes) {
  const auto& [a, b, c] = vertices;
  if (attributes.w) w.push_back({a.w, b.w, c.w});
  if (attributes.color) colors.push_back({a.color, b.color, c.color});
  if (attributes.normal) normals.push_back({a.normal, b.normal, c.normal});
}

}  // namespace pipeline
