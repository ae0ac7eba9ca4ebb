#include "libpipeline/stream/stage_writer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string_view>
#include <utility>

#include "libpipeline/text/fixed_text.h"

namespace pipeline {
namespace {

/// Prints a header line or, if `rest` is no line end, the beginning of one.
void print_numbers(TextWriter& text, std::string_view keyword, std::initializer_list<double> numbers,
                   std::string_view rest = "\n") {
  text.append(keyword);
  for (const double number : numbers) {
    char* out = text.reserve(kMaxNumberLength + 1);
    *out++ = ' ';
    text.commit(print_number(out, number, 0, {.shortest = true}));
  }
  text.append(rest);
}

void print_vec3(TextWriter& text, std::string_view keyword, const std::optional<Located<Vec3>>& v) {
  if (v) print_numbers(text, keyword, {v->value.x, v->value.y, v->value.z});
}

void print_projection(TextWriter& text, const Projection& projection) {
  if (const auto* p = std::get_if<Perspective>(&projection)) {
    print_numbers(text, "perspective", {p->fov_y_degrees, p->aspect, p->near, p->far},
                  p->aspect_rule == AspectRule::ratio ? " ratio\n" : "\n");
  } else if (const auto* f = std::get_if<Frustum>(&projection)) {
    print_numbers(text, "frustum", {f->left, f->right, f->bottom, f->top, f->near, f->far});
  } else {
    const auto& o = std::get<Orthographic>(projection);
    print_numbers(text, "ortho", {o.left, o.right, o.bottom, o.top, o.near, o.far});
  }
}

void print_appearance(TextWriter& text, const Appearance& appearance) {
  if (appearance.attributes) text.append(attributes_line(appearance.attributes->value) + "\n");
  if (appearance.background) {
    const auto& [color, alpha] = appearance.background->value;
    print_numbers(text, "background", {color.x, color.y, color.z}, alpha < 255 ? "" : "\n");
    if (alpha < 255) print_numbers(text, "", {alpha});
  }
  print_vec3(text, "ambient", appearance.ambient);
  for (const auto& [m, location] : appearance.materials) {
    const bool is_traced = m.reflectance != 0 || m.index != 1 || m.alpha != 1;
    print_numbers(text, "material", {m.ambient, m.diffuse, m.specular},
                  " " + std::to_string(m.shininess) + (is_traced ? "" : "\n"));
    if (is_traced) print_numbers(text, "", {m.reflectance, m.index, m.alpha});
    if (m.absorption != Vec3{})
      print_numbers(text, "absorption", {m.absorption.x, m.absorption.y, m.absorption.z});
    if (m.paint) print_numbers(text, "paint", {m.paint->x, m.paint->y, m.paint->z});
  }
  if (appearance.attenuation) {
    const Attenuation& a = appearance.attenuation->value;
    print_numbers(text, "attenuation", {a.constant, a.linear, a.quadratic});
  }
  for (const auto& [light, location] : appearance.lights) {
    const auto& [p, i] = light;
    print_numbers(text, "light", {p.x, p.y, p.z, i.x, i.y, i.z});
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
  print_vec3(text_, "eye", camera.eye);
  print_vec3(text_, "look", camera.look);
  print_vec3(text_, "up", camera.up);
  if (camera.projection) print_projection(text_, camera.projection->value);
  if (header.projected) {
    text_.append("projected ");
    print_projection(text_, header.projected->value);
  }
  if (header.bounds) {
    const auto& [error, rounded, space] = header.bounds->value;
    text_.append("bounds ");
    print_numbers(text_, space, {error.absolute, error.relative}, rounded ? "" : "\n");
    if (rounded) print_numbers(text_, "", {rounded->absolute, rounded->relative});
  }
  print_appearance(text_, header.appearance);
  columns_ = header.appearance.columns();
}

void StageWriter::write(const TriangleBatch& batch) {
  assert(batch.low_parts.empty() || batch.low_parts.size() == batch.size());
  for (std::size_t i = 0, end = 0; i < batch.size(); i = end) {
    end = begin_run(batch, i);
    write_columns(fixed_columns(batch.triangles, batch.attributes, columns_, i, end - i),
                  batch.low_parts.empty() ? nullptr : &batch.low_parts[i], format_, text_);
  }
  for (const Sphere& sphere : batch.spheres) write_sphere(sphere);
}

/// Writes the lines before those of triangle `begin`. Returns the end of a run whose other triangles need
/// none; it may be short.
std::size_t StageWriter::begin_run(const TriangleBatch& batch, std::size_t begin) {
  constexpr std::size_t kMaxAtOnce = 256;
  write_number(batch.numbers[begin]);
  if (const ClipTriangle* const unclipped = batch.unclipped_of(begin);
      unclipped != nullptr && unclipped != last_unclipped_.get()) {
    write_clipped(*unclipped, batch.attributes, begin);
    last_unclipped_ = batch.unclipped[begin];
  }
  if (!batch.low_parts.empty() || !batch.unclipped.empty()) return begin + 1;
  const std::size_t limit = std::min(batch.size(), begin + kMaxAtOnce);
  std::size_t last = begin + 1;
  while (last < limit && (bare_ || batch.numbers[last] == next_number_ + (last - begin - 1))) ++last;
  next_number_ = batch.numbers[last - 1] + 1;
  return last;
}

void StageWriter::write_sphere(const Sphere& sphere) {
  assert(!bare_ && !columns_.w);
  write_number(sphere.number);
  text_.append("sphere\n");
  char* out = text_.reserve(sphere.points.size() * 7 * (kMaxNumberLength + 1) + 1);
  for (std::size_t i = 0; i < sphere.points.size(); ++i) {
    out = print_three(out, sphere.points[i], sphere.low_parts[i], format_);
    if (columns_.color) out = print_three(out, sphere.color.value_or(Vec3{}), {}, format_);
    if (columns_.material) out = print_number(out, sphere.material, 0, {.decimals = 0}) + 1;
    out[-1] = '\n';
  }
  *out++ = '\n';
  text_.commit(out);
}

/// Prints an unclipped triangle before its first piece, whose material it has. Its corners are lit, so they
/// are not rounded.
void StageWriter::write_clipped(const ClipTriangle& unclipped, const AttributeArrays& attributes,
                                std::size_t index) {
  text_.append("clipped\n");
  const auto& [a, b, c] = unclipped;
  const std::array<Triangle, 1> positions = {{{a.position, b.position, c.position}}};
  AttributeSet names = columns_;
  names.w = true;
  clipped_.truncate(0);
  clipped_.add({unclipped, names.material ? attributes.materials[index] : 0}, names);
  write_columns(fixed_columns(positions, std::as_const(clipped_), names, 0, 1), nullptr, kShortest, text_);
}

/// Prints the number of the next triangle unless it follows the last number.
void StageWriter::write_number(std::uint64_t number) {
  if (number != next_number_ && !bare_) text_.append("triangle " + std::to_string(number) + "\n");
  next_number_ = number + 1;
}

void StageWriter::finish() {
  if (framed_) text_.append("end\n");
  text_.flush();
}

}  // namespace pipeline
