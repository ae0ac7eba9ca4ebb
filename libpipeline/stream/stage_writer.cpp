#include "libpipeline/stream/stage_writer.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string_view>

#include "libpipeline/text/fixed_text.h"

namespace pipeline {
namespace {

// Position, w, color, normal and material.
constexpr std::size_t kMaxVertexLength = 11 * (kMaxNumberLength + 1);
// "triangle N", three vertex lines and the blank line.
constexpr std::size_t kMaxTriangleLength = 40 + 3 * kMaxVertexLength + 1;

/// Prints all digits: readers take no exponent here.
char* print_material(char* out, std::uint32_t material) {
  return print_number(out, material, 0, {.decimals = 0});
}

void print_numbers(TextWriter& text, std::string_view keyword, std::initializer_list<double> numbers) {
  text.append(keyword);
  for (const double number : numbers) {
    char* out = text.reserve(kMaxNumberLength + 1);
    *out++ = ' ';
    text.commit(print_number(out, number, 0, {.shortest = true}));
  }
}

void print_header_numbers(TextWriter& text, std::string_view keyword, std::initializer_list<double> numbers) {
  print_numbers(text, keyword, numbers);
  text.append("\n");
}

void print_projection(TextWriter& text, const Projection& projection) {
  if (const auto* p = std::get_if<Perspective>(&projection)) {
    print_numbers(text, "perspective", {p->fov_y_degrees, p->aspect, p->near, p->far});
    text.append(p->aspect_rule == AspectRule::ratio ? " ratio\n" : "\n");
  } else if (const auto* f = std::get_if<Frustum>(&projection)) {
    print_header_numbers(text, "frustum", {f->left, f->right, f->bottom, f->top, f->near, f->far});
  } else {
    const auto& o = std::get<Orthographic>(projection);
    print_header_numbers(text, "ortho", {o.left, o.right, o.bottom, o.top, o.near, o.far});
  }
}

void print_attribute_names(TextWriter& text, const AttributeSet& attributes) {
  text.append("attributes");
  if (attributes.w) text.append(" w");
  if (attributes.color) text.append(" color");
  if (attributes.normal) text.append(" normal");
  if (attributes.material) text.append(" material");
  text.append("\n");
}

void print_appearance(TextWriter& text, const Appearance& appearance) {
  const auto print_vec3 = [&](std::string_view keyword, const std::optional<Located<Vec3>>& v) {
    if (v) print_header_numbers(text, keyword, {v->value.x, v->value.y, v->value.z});
  };
  if (appearance.attributes) print_attribute_names(text, appearance.attributes->value);
  if (appearance.background) {
    const auto& [color, alpha] = appearance.background->value;
    print_numbers(text, "background", {color.x, color.y, color.z});
    if (alpha < 255) print_numbers(text, "", {alpha});
    text.append("\n");
  }
  print_vec3("ambient", appearance.ambient);
  for (const auto& [m, location] : appearance.materials) {
    print_numbers(text, "material", {m.ambient, m.diffuse, m.specular});
    text.append(" " + std::to_string(m.shininess));
    if (m.reflectance != 0 || m.index != 1 || m.alpha != 1)
      print_numbers(text, "", {m.reflectance, m.index, m.alpha});
    text.append("\n");
    if (m.absorption != Vec3{})
      print_header_numbers(text, "absorption", {m.absorption.x, m.absorption.y, m.absorption.z});
  }
  if (appearance.attenuation) {
    const Attenuation& a = appearance.attenuation->value;
    print_header_numbers(text, "attenuation", {a.constant, a.linear, a.quadratic});
  }
  for (const auto& [light, location] : appearance.lights) {
    const auto& [p, i] = light;
    print_header_numbers(text, "light", {p.x, p.y, p.z, i.x, i.y, i.z});
  }
}

}  // namespace

StageWriter::StageWriter(TextWriter& text, NumberFormat format, bool bare)
    : text_(text), format_(format), bare_(bare) {}

void StageWriter::write_header(const StageHeader& header) {
  if (bare_) return;
  framed_ = header.framed;
  if (framed_) text_.append("framed\n");
  const CameraParameters& camera = header.camera;
  const auto print_vec3 = [&](std::string_view keyword, const std::optional<Located<Vec3>>& v) {
    if (v) print_header_numbers(text_, keyword, {v->value.x, v->value.y, v->value.z});
  };
  print_vec3("eye", camera.eye);
  print_vec3("look", camera.look);
  print_vec3("up", camera.up);
  if (camera.projection) print_projection(text_, camera.projection->value);
  if (header.projected) {
    text_.append("projected ");
    print_projection(text_, header.projected->value);
  }
  print_appearance(text_, header.appearance);
  columns_ = header.appearance.columns();
}

void StageWriter::write(const TriangleBatch& batch) {
  assert(batch.low_parts.empty() || batch.low_parts.size() == batch.size());
  if (!keeps_four_digits_) note_sizes(batch);
  std::size_t begin = 0;
  for (const std::size_t sphere : batch.spheres) {
    write_triangles(batch, begin, sphere);
    write_sphere(batch, sphere);
    begin = sphere + 2;
  }
  write_triangles(batch, begin, batch.size());
}

/// Writes the triangles [begin, end), none of which is a sphere.
void StageWriter::write_triangles(const TriangleBatch& batch, std::size_t begin, std::size_t end) {
  const bool has_runs = has_fast_path() && batch.low_parts.empty() && batch.unclipped.empty();
  std::size_t index = begin;
  std::size_t end_of_run = 0;
  while (index < end) {
    if (has_runs && index >= end_of_run) end_of_run = end_of_numbered_run(batch, index, end);
    const bool is_run = index < end_of_run;
    if (is_run) index += write_block(batch, index, end_of_run);
    const bool is_refused = is_run && index < end_of_run;
    if (index < end) write_triangle(batch, index++, has_fast_path() && !is_refused);
  }
}

/// Whether write_block may print triangles with these digits.
bool StageWriter::has_fast_path() const {
  return format_.decimals <= kMaxFixedDecimals || format_.shortest;
}

/// The end of the triangles of [begin, end) that need no `triangle N`, or of a part of them.
std::size_t StageWriter::end_of_numbered_run(const TriangleBatch& batch, std::size_t begin,
                                             std::size_t end) const {
  constexpr std::size_t kMaxAtOnce = 256;
  const std::size_t limit = std::min(end, begin + kMaxAtOnce);
  std::size_t last = begin;
  while (last < limit && (bare_ || batch.numbers[last] == next_number_ + (last - begin))) ++last;
  return last;
}

/// Looks at every coordinate until one keeps four digits in the text, which settles the question.
void StageWriter::note_sizes(const TriangleBatch& batch) {
  double smallest_with_four_digits = 1000;
  for (int i = 0; i < format_.decimals; ++i) smallest_with_four_digits /= 10;
  for (const Triangle& triangle : batch.triangles) {
    for (const Vec3& vertex : triangle) {
      for (const double coordinate : {vertex.x, vertex.y, vertex.z}) {
        has_filled_coordinate_ |= coordinate != 0;
        keeps_four_digits_ |= format_.shortest || std::fabs(coordinate) >= smallest_with_four_digits;
      }
    }
    if (keeps_four_digits_) return;
  }
}

/// Prints the triangles [begin, end), which need no `triangle N`, as long as a fast path has them; returns
/// how many.
std::size_t StageWriter::write_block(const TriangleBatch& batch, std::size_t begin, std::size_t end) {
  const std::size_t max_length = format_.shortest ? kMaxShortestColumnsLength
                                 : columns_.any() ? kMaxFixedColumnsLength
                                                  : kMaxFixedTriangleLength;
  char* const out = text_.reserve((end - begin) * max_length + kFixedTextSlack);
  const ConstFixedColumns columns =
      fixed_columns(batch.triangles, batch.attributes, columns_, begin, end - begin);
  FixedTextPart part;
  if (format_.shortest)
    part = {end - begin, static_cast<std::size_t>(write_shortest_columns(columns, out) - out)};
  else
    part = write_fixed_columns(columns, format_.decimals, out);
  text_.commit(out + part.length);
  const std::size_t count = part.triangle_count;
  if (count > 0) next_number_ = batch.numbers[begin + count - 1] + 1;
  return count;
}

void StageWriter::write_triangle(const TriangleBatch& batch, std::size_t index, bool tries_fast_path) {
  write_number(batch.numbers[index]);
  next_number_ = batch.numbers[index] + 1;
  if (const ClipTriangle* const unclipped = batch.unclipped_of(index);
      unclipped != nullptr && unclipped != last_unclipped_.get()) {
    write_clipped(*unclipped, batch.attributes, index);
    last_unclipped_ = batch.unclipped[index];
  }
  const Triangle low_part = batch.low_parts.empty() ? Triangle{} : batch.low_parts[index];
  if (tries_fast_path && low_part == Triangle{} && write_block(batch, index, index + 1) == 1) return;
  char* out = text_.reserve(kMaxTriangleLength);
  for (std::size_t v = 0; v < 3; ++v) {
    out = print_vertex(out, batch.triangles[index][v], low_part[v]);
    if (columns_.any()) out = print_attributes(out, batch.attributes, columns_, index, v);
    *out++ = '\n';
  }
  *out++ = '\n';
  text_.commit(out);
}

/// Prints the sphere whose first entry is `index`.
void StageWriter::write_sphere(const TriangleBatch& batch, std::size_t index) {
  assert(!bare_ && !columns_.w);
  write_number(batch.numbers[index]);
  next_number_ = batch.numbers[index] + 1;
  text_.append("sphere\n");
  const SpherePoints points = batch.sphere_points(index);
  const SpherePoints low_parts =
      batch.low_parts.empty() ? SpherePoints{} : TriangleBatch::points_of(batch.low_parts, index);
  AttributeSet columns = columns_;
  columns.normal = false;
  char* out = text_.reserve(points.size() * kMaxVertexLength + 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    out = print_vertex(out, points[i], low_parts[i]);
    out = print_attributes(out, batch.attributes, columns, index, 0);
    *out++ = '\n';
  }
  *out++ = '\n';
  text_.commit(out);
}

/// Prints an unclipped triangle before its first piece, which has its material. Its corners are lit, so they
/// are not rounded.
void StageWriter::write_clipped(const ClipTriangle& unclipped, const AttributeArrays& attributes,
                                std::size_t index) {
  text_.append("clipped\n");
  for (const auto& [p, w, color, normal] : unclipped) {
    char* out = text_.reserve(kMaxVertexLength);
    const auto print = [&](std::initializer_list<double> numbers) {
      for (const double number : numbers) {
        out = print_number(out, number, 0, {.shortest = true});
        *out++ = ' ';
      }
    };
    print({p.x, p.y, p.z, w});
    if (columns_.color) print({color.x, color.y, color.z});
    if (columns_.normal) print({normal.x, normal.y, normal.z});
    if (columns_.material) out = print_material(out, attributes.materials[index]) + 1;
    out[-1] = '\n';
    text_.commit(out);
  }
  text_.append("\n");
}

/// Prints three numbers separated by blanks.
char* StageWriter::print_vertex(char* out, const Vec3& vertex, const Vec3& low_part) {
  out = print_number(out, vertex.x, low_part.x, format_);
  *out++ = ' ';
  out = print_number(out, vertex.y, low_part.y, format_);
  *out++ = ' ';
  return print_number(out, vertex.z, low_part.z, format_);
}

char* StageWriter::print_attributes(char* out, const AttributeArrays& attributes, const AttributeSet& columns,
                                    std::size_t index, std::size_t vertex) {
  const auto print_vec3 = [&](const Vec3& v) {
    *out++ = ' ';
    out = print_vertex(out, v, {});
  };
  if (columns.w) {
    *out++ = ' ';
    out = print_number(out, attributes.w[index][vertex], 0, {.shortest = true});
  }
  if (columns.color) print_vec3(attributes.colors[index][vertex]);
  if (columns.normal) print_vec3(attributes.normals[index][vertex]);
  if (columns.material) {
    *out++ = ' ';
    out = print_material(out, attributes.materials[index]);
  }
  return out;
}

/// Prints the number of the next triangle if it is not the one that counting on would give.
void StageWriter::write_number(std::uint64_t number) {
  if (number != next_number_ && !bare_) text_.append("triangle " + std::to_string(number) + "\n");
}

void StageWriter::finish() {
  if (framed_) text_.append("end\n");
  text_.flush();
}

}  // namespace pipeline
