#include "libpipeline/picture/surface_shader.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

// Surfaces ready to be shaded: 150 KiB.
constexpr std::size_t kMaxCached = 512;

SurfacePoint middle(const std::array<SurfacePoint, 3>& p) {
  constexpr std::array<double, 3> kEqual = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  return {mean(Triangle{p[0].position, p[1].position, p[2].position}, kEqual),
          mean(Triangle{p[0].normal, p[1].normal, p[2].normal}, kEqual),
          mean(Triangle{p[0].color, p[1].color, p[2].color}, kEqual)};
}

/// Gives every corner the normal of the triangle.
void use_face_normal(std::array<SurfacePoint, 3>& corners) {
  const Vec3 normal = face_normal({corners[0].position, corners[1].position, corners[2].position});
  for (SurfacePoint& corner : corners) corner.normal = normal;
}

/// The index of the first pixel that shows a surface; the number of pixels if none does.
std::size_t first_surface(std::span<const SurfaceShader::SurfaceId> ids) {
  const auto is_surface = [](SurfaceShader::SurfaceId id) { return id != SurfaceShader::kNoSurface; };
  return static_cast<std::size_t>(std::ranges::find_if(ids, is_surface) - ids.begin());
}

bool differ_visibly(Color a, Color b) {
  const auto differ = [](int p, int q) { return std::abs(p - q) > 1; };
  return differ(a.red(), b.red()) || differ(a.green(), b.green()) || differ(a.blue(), b.blue()) ||
         differ(a.alpha(), b.alpha());
}

}  // namespace

void ShownColors::add_triangle(const std::array<Vec3, 3>& colors) {
  if (greatest_channel.value_or(0) > 1) return;
  for (const Vec3& c : colors) greatest_channel = std::max({greatest_channel.value_or(0), c.x, c.y, c.z});
}

void ShownColors::add_pixel(Color color, Color background) {
  if (!show_something) show_something = differ_visibly(color, background);
}

void ShownColors::add(const ShownColors& others) {
  show_something = show_something || others.show_something;
  if (others.light_in_front) light_in_front = std::max(light_in_front.value_or(0), *others.light_in_front);
  if (others.greatest_channel)
    greatest_channel = std::max(greatest_channel.value_or(0), *others.greatest_channel);
}

/// The triangle with its attributes; for a piece, the triangle it was clipped from.
SurfaceShader::KeptTriangle SurfaceShader::unclipped(const TriangleBatch& p_ndc, std::size_t index,
                                                     Color own_color) const {
  const AttributeArrays& attributes = p_ndc.attributes;
  const ClipTriangle* const whole = p_ndc.unclipped_of(index);
  KeptTriangle kept;
  kept.is_divided = whole == nullptr;
  if (whole != nullptr)
    kept.corners = *whole;
  else
    attributes.copy(index, kept.corners);
  for (std::size_t v = 0; v < 3; ++v) {
    VertexLine& corner = kept.corners[v];
    if (attributes.colors.empty()) corner.color = to_vec3(own_color);
    if (whole != nullptr) continue;
    const Vec3& p = corner.position = p_ndc.triangles[index][v];
    if (attributes.w.empty()) corner.w = setup_.view_from_clip ? setup_.view_from_clip->w_of(p) : 1;
  }
  return kept;
}

SurfaceShader::SurfaceId SurfaceShader::add(const TriangleBatch& p_ndc, std::size_t index, Color own_color) {
  if (!p_ndc.attributes.colors.empty()) shown_.add_triangle(p_ndc.attributes.colors[index]);
  const KeptTriangle kept = unclipped(p_ndc, index, own_color);
  has_normals_ = !p_ndc.attributes.normals.empty();
  triangles_.push_back(kept);
  if (setup_.materials.size() > 1 && !p_ndc.attributes.materials.empty())
    materials_.push_back(p_ndc.attributes.materials[index]);
  assert(triangles_.size() < kNoSurface);
  return static_cast<SurfaceId>(triangles_.size() - 1);
}

const SurfaceShader::Surface& SurfaceShader::surface(SurfaceId id, Worker& worker) const {
  CachedSurface& cached = worker.cache[id % worker.cache.size()];
  if (cached.id != id)
    cached = {id, made_surface(triangles_[id], has_normals_, materials_.size() == 0 ? 0 : materials_[id])};
  return cached.surface;
}

SurfaceShader::Surface SurfaceShader::made_surface(const KeptTriangle& kept, bool has_normals,
                                                   std::uint32_t material) const {
  Surface surface = {CornerWeights(grid_, kept.corners, kept.is_divided), {}, material};
  for (std::size_t v = 0; v < 3; ++v) {
    const auto& [p, w, color, normal] = kept.corners[v];
    const Vec3 p_clip = kept.is_divided ? scaled(p, w) : p;
    const Vec3 p_view = setup_.view_from_clip ? (*setup_.view_from_clip)(p_clip, w) : Vec3();
    surface.corners[v] = {p_view, normal, color};
  }
  if (!has_normals || setup_.model == ShadingModel::flat) use_face_normal(surface.corners);
  light_corners(surface);
  return surface;
}

void SurfaceShader::keep(const KeptIds& kept) {
  assert(kept.size() == triangles_.size());
  triangles_.keep(kept);
  materials_.keep(kept);
  for (Worker& worker : workers_) worker.cache.clear();
}

void SurfaceShader::light_corners(Surface& surface) const {
  if (setup_.model == ShadingModel::flat) {
    const Vec3 color = lit_color_of(middle(surface.corners), surface);
    for (SurfacePoint& corner : surface.corners) corner.color = color;
  } else if (setup_.model == ShadingModel::gouraud) {
    for (SurfacePoint& corner : surface.corners) corner.color = clamped_color(lit_color_of(corner, surface));
  }
}

std::span<const Color> SurfaceShader::shade(int row, std::span<const SurfaceId> ids, int number) {
  Worker& worker = workers_[static_cast<std::size_t>(number)];
  worker.row.resize(ids.size() + kMaxLanesShaded);  // the last run may write beyond it
  if (worker.cache.empty()) worker.cache.resize(std::min(std::bit_ceil(ids.size()), kMaxCached));
  const std::size_t first = first_surface(ids);
  std::fill_n(worker.row.begin(), first, setup_.background);
  // Neighbors mostly show the same triangle, which is looked up once.
  for (std::size_t column = first, end; column < ids.size(); column = end) {
    end = column + 1;
    while (end < ids.size() && ids[end] == ids[column]) ++end;
    shade_columns(row, column, end, ids[column], worker);
  }
  worker.row.resize(ids.size());
  if (!worker.shown.show_something && first < ids.size()) look_for_something(first, ids, worker);
  return worker.row;
}

void SurfaceShader::look_for_something(std::size_t first, std::span<const SurfaceId> ids,
                                       Worker& worker) const {
  ShownColors& shown = worker.shown;
  const auto shows = [&](Color color) { return differ_visibly(color, setup_.background); };
  shown.show_something =
      std::any_of(worker.row.begin() + static_cast<std::ptrdiff_t>(first), worker.row.end(), shows);
  if (shown.show_something || setup_.model == ShadingModel::none) return;
  for (std::size_t i = first; i < ids.size(); ++i)
    if (ids[i] != kNoSurface && (i == first || ids[i] != ids[i - 1]))
      shown.light_in_front =
          std::max(shown.light_in_front.value_or(0), light_in_front_of(surface(ids[i], worker)));
}

/// The greatest intensity of the lights in front of a surface, where it is lit once, or at a corner: those
/// that would light it if they were white and no distance weakened them.
double SurfaceShader::light_in_front_of(const Surface& surface) const {
  std::array<SurfacePoint, 3> points = surface.corners;
  if (setup_.model == ShadingModel::flat) points.fill(middle(points));
  for (SurfacePoint& point : points) point.color = {1, 1, 1};
  Lighting alone;
  alone.is_perspective = setup_.lighting.is_perspective;
  double greatest = 0;
  for (const Light& light : setup_.lighting.lights) {
    alone.lights = {{light.position, {1, 1, 1}}};
    if (std::ranges::any_of(points, [&](const SurfacePoint& point) { return lit_color(point, alone).x > 0; }))
      greatest = std::max({greatest, light.intensity.x, light.intensity.y, light.intensity.z});
  }
  return greatest;
}

void SurfaceShader::shade_columns(int row, std::size_t begin, std::size_t end, SurfaceId id,
                                  Worker& worker) const {
  Color* const colors = worker.row.data();
  if (id == kNoSurface) {
    std::fill(colors + begin, colors + end, setup_.background);
    return;
  }
  shade_run(surface(id, worker), row, static_cast<int>(begin), static_cast<int>(end - begin), colors + begin);
}

void SurfaceShader::shade_run(const Surface& surface, int row, int column, int count, Color* colors) const {
  if (setup_.model == ShadingModel::flat) {
    std::fill_n(colors, count, rounded_color(surface.corners[0].color));
    return;
  }
  const Material* const lit_by_pixel =
      setup_.model == ShadingModel::phong ? &setup_.materials[surface.material] : nullptr;
  run_shader()({surface.weights, surface.corners, lit_by_pixel, grid_, row, column, count}, setup_.lighting,
               colors);
}

Color SurfaceShader::color_at(const Surface& surface, int row, int column) const {
  std::array<Color, kMaxLanesShaded> colors;
  shade_run(surface, row, column, 1, colors.data());
  return colors[0];
}

}  // namespace pipeline
