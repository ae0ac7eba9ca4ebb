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

/// Prints three numbers, with a blank after each.
char* print_three(char* out, const Vec3& v, const Vec3& low_part, NumberFormat format) {
  out = print_number(out, v.x, low_part.x, format);
  *out++ = ' ';
  out = print_number(out, v.y, low_part.y, format);
  *out++ = ' ';
  out = print_number(out, v.z, low_part.z, format);
  *out++ = ' ';
  return out;
}

/// Prints a vertex line by the general path; w has its shortest form, the material all digits.
char* print_line(char* out, const Vec3& position, const Vec3& low_part, const AttributeSet& columns,
                 const VertexLine& vertex, std::uint32_t material, NumberFormat format) {
  out = print_three(out, position, low_part, format);
  if (columns.w) *(out = print_number(out, vertex.w, 0, kShortest))++ = ' ';
  if (columns.color) out = print_three(out, vertex.color, {}, format);
  if (columns.normal) out = print_three(out, vertex.normal, {}, format);
  if (columns.material) out = print_number(out, material, 0, {.decimals = 0}) + 1;
  out[-1] = '\n';
  return out;
}

/// The columns of a vertex line after its position.
VertexLine columns_of(const AttributeArrays& attributes, std::size_t index, std::size_t vertex,
                      const AttributeSet& columns) {
  VertexLine line;
  if (columns.w) line.w = attributes.w[index][vertex];
  if (columns.color) line.color = attributes.colors[index][vertex];
  if (columns.normal) line.normal = attributes.normals[index][vertex];
  return line;
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
    if (m.paint) print_header_numbers(text, "paint", {m.paint->x, m.paint->y, m.paint->z});
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

/// Writes the triangles [begin, end), none of which is a sphere: by the fast path as far as it has them.
void StageWriter::write_triangles(const TriangleBatch& batch, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin, end_of_run = begin; i < end;) {
    if (i == end_of_run) end_of_run = begin_run(batch, i, end);
    const bool has_low_part = !batch.low_parts.empty() && batch.low_parts[i] != Triangle{};
    if (!has_low_part)
      i += write_columns(fixed_columns(batch.triangles, batch.attributes, columns_, i, end_of_run - i),
                         format_, text_);
    if (i < end_of_run) write_triangle(batch, i++);
  }
}

/// Writes what stands before the lines of triangle `begin`. Returns the end of the triangles of [begin, end)
/// that need no such lines after it, or of a part of them.
std::size_t StageWriter::begin_run(const TriangleBatch& batch, std::size_t begin, std::size_t end) {
  constexpr std::size_t kMaxAtOnce = 256;
  write_number(batch.numbers[begin]);
  if (const ClipTriangle* const unclipped = batch.unclipped_of(begin);
      unclipped != nullptr && unclipped != last_unclipped_.get()) {
    write_clipped(*unclipped, batch.attributes, begin);
    last_unclipped_ = batch.unclipped[begin];
  }
  if (!batch.low_parts.empty() || !batch.unclipped.empty()) return begin + 1;
  const std::size_t limit = std::min(end, begin + kMaxAtOnce);
  std::size_t last = begin + 1;
  while (last < limit && (bare_ || batch.numbers[last] == next_number_ + (last - begin - 1))) ++last;
  next_number_ = batch.numbers[last - 1] + 1;
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

/// Writes the lines of a triangle by the general path.
void StageWriter::write_triangle(const TriangleBatch& batch, std::size_t index) {
  const Triangle low_part = batch.low_parts.empty() ? Triangle{} : batch.low_parts[index];
  const std::uint32_t material = columns_.material ? batch.attributes.materials[index] : 0;
  char* out = text_.reserve(kMaxTriangleLength);
  for (std::size_t v = 0; v < 3; ++v) {
    const Vec3& position = batch.triangles[index][v];
    out = columns_.any() ? print_line(out, position, low_part[v], columns_,
                                      columns_of(batch.attributes, index, v, columns_), material, format_)
                         : print_three(out, position, low_part[v], format_);
    out[-1] = '\n';
  }
  *out++ = '\n';
  text_.commit(out);
}

/// Prints the sphere whose first entry is `index`.
void StageWriter::write_sphere(const TriangleBatch& batch, std::size_t index) {
  assert(!bare_ && !columns_.w);
  write_number(batch.numbers[index]);
  text_.append("sphere\n");
  const SpherePoints points = batch.sphere_points(index);
  const SpherePoints low_parts =
      batch.low_parts.empty() ? SpherePoints{} : TriangleBatch::points_of(batch.low_parts, index);
  AttributeSet columns = columns_;
  columns.normal = false;
  const VertexLine line = columns_of(batch.attributes, index, 0, columns);
  const std::uint32_t material = columns.material ? batch.attributes.materials[index] : 0;
  char* out = text_.reserve(points.size() * kMaxVertexLength + 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    out = print_line(out, points[i], low_parts[i], columns, line, material, format_);
  *out++ = '\n';
  text_.commit(out);
}

/// Prints an unclipped triangle before its first piece, which has its material. Its corners are lit, so they
/// are not rounded.
void StageWriter::write_clipped(const ClipTriangle& unclipped, const AttributeArrays& attributes,
                                std::size_t index) {
  text_.append("clipped\n");
  AttributeSet columns = columns_;
  columns.w = true;
  const std::uint32_t material = columns.material ? attributes.materials[index] : 0;
  for (const VertexLine& corner : unclipped)
    text_.commit(print_line(text_.reserve(kMaxVertexLength), corner.position, {}, columns, corner, material,
                            kShortest));
  text_.append("\n");
}

/// Prints the number of the next triangle if it is not the one that counting on would give.
void StageWriter::write_number(std::uint64_t number) {
  if (number != next_number_ && !bare_) text_.append("triangle " + std::to_string(number) + "\n");
  next_number_ = number + 1;
}

void StageWriter::finish() {
  if (framed_) text_.append("end\n");
  text_.flush();
}

}  // namespace pipeline
