#include "libpipeline/picture/surface_shader.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "libpipeline/numbers/vec_math.h"

namespace pipeline {
namespace {

// The count of surfaces ready to be shaded.
constexpr std::size_t kMaxCached = 512;

SurfacePoint middle(const std::array<SurfacePoint, 3>& p) {
  constexpr std::array<double, 3> kEqual = {1.0 / 3, 1.0 / 3, 1.0 / 3};
  return {mean(Triangle{p[0].position, p[1].position, p[2].position}, kEqual),
          mean(Triangle{p[0].normal, p[1].normal, p[2].normal}, kEqual),
          mean(Triangle{p[0].color, p[1].color, p[2].color}, kEqual)};
}

}  // namespace

/// The triangle with its attributes; for a piece, the triangle it was clipped from.
SurfaceShader::KeptTriangle SurfaceShader::unclipped(const TriangleBatch& p_ndc, std::size_t index,
                                                     Color own_color) const {
  const AttributeArrays& attributes = p_ndc.attributes;
  const ClipTriangle* const whole = p_ndc.unclipped_of(index);
  KeptTriangle kept;
  kept.is_divided = whole == nullptr;
  kept.has_normals = !attributes.normals.empty();
  if (!attributes.materials.empty()) kept.material = attributes.materials[index];
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
  triangles_.push_back(unclipped(p_ndc, index, own_color));
  assert(triangles_.size() < kNoSurface);
  return static_cast<SurfaceId>(triangles_.size() - 1);
}

const SurfaceShader::Surface& SurfaceShader::surface(SurfaceId id, Worker& worker) const {
  CachedSurface& cached = worker.cache[id % worker.cache.size()];
  if (cached.id != id) cached = {id, made_surface(triangles_[id])};
  return cached.surface;
}

SurfaceShader::Surface SurfaceShader::made_surface(const KeptTriangle& kept) const {
  Surface surface = {CornerWeights(grid_, kept.corners, kept.is_divided), {}, kept.material};
  for (std::size_t v = 0; v < 3; ++v) {
    const auto& [p, w, color, normal] = kept.corners[v];
    const Vec3 p_clip = kept.is_divided ? scaled(p, w) : p;
    const Vec3 p_view = setup_.view_from_clip ? (*setup_.view_from_clip)(p_clip, w) : Vec3();
    surface.corners[v] = {p_view, normal, color};
  }
  auto& [a, b, c] = surface.corners;
  surface.greatest_channel = largest_in(BoundingBox({a.color, b.color, c.color}).high);
  if (!kept.has_normals || setup_.model == ShadingModel::flat)
    a.normal = b.normal = c.normal = face_normal({a.position, b.position, c.position});
  light_corners(surface);
  return surface;
}

void SurfaceShader::keep(const KeptIds& kept) {
  assert(kept.size() == triangles_.size());
  triangles_.keep(kept);
  for (Worker& worker : workers_) worker.cache.clear(), worker.dark_pixels.clear(), worker.seen.clear();
}

void SurfaceShader::light_corners(Surface& surface) const {
  const auto lit = [&](const SurfacePoint& point) {
    return lit_color(point, setup_.lighting, setup_.materials[surface.material]);
  };
  if (setup_.model == ShadingModel::flat) {
    const Vec3 color = lit(middle(surface.corners));
    for (SurfacePoint& corner : surface.corners) corner.color = color;
  } else if (setup_.model == ShadingModel::gouraud) {
    for (SurfacePoint& corner : surface.corners) corner.color = clamped_color(lit(corner));
  }
}

std::span<const Color> SurfaceShader::shade(int row, std::span<const SurfaceId> ids, int number) {
  Worker& worker = workers_[static_cast<std::size_t>(number)];
  worker.row.resize(ids.size() + kMaxLanesShaded);  // the last run may write beyond the row
  if (worker.cache.empty()) worker.cache.resize(std::min(std::bit_ceil(ids.size()), kMaxCached));
  const bool is_looking =
      !worker.shown.is_varied ||
      (row % row_stride() == 0 && static_cast<double>(worker.shown.visible) < enough_visible());
  // Neighbors mostly show the same triangle, so it is looked up once.
  for (std::size_t column = 0, end; column < ids.size(); column = end) {
    const SurfaceId id = ids[column];
    for (end = column + 1; end < ids.size() && ids[end] == id;) ++end;
    const std::span<Color> run(worker.row.data() + column, end - column);
    if (id == kNoSurface) {
      std::ranges::fill(run, setup_.background);
      continue;
    }
    worker.shown.has_surface = true;
    shade_run(surface(id, worker), row, static_cast<int>(column), static_cast<int>(run.size()), run.data());
    if (is_looking) look_at_run(id, run, worker);
  }
  worker.row.resize(ids.size());
  return worker.row;
}

void SurfaceShader::look_at_run(SurfaceId id, std::span<const Color> colors, Worker& worker) const {
  ShownColors& shown = worker.shown;
  std::uint32_t dark_count = 0;
  for (const Color color : colors) {
    if (shown.is_varied && setup_.background.rgb() == 0 && looks_colored(color))
      ++shown.visible;
    else if (shown.add(color, setup_.background, is_lit()))
      ++dark_count;
  }
  const auto entry_of = [&](auto& of_ids) {
    if (of_ids.size() <= id) of_ids.resize(triangles_.size());
    return of_ids.begin() + id;
  };
  if (dark_count > 0) *entry_of(worker.dark_pixels) += dark_count;
  if (!shown.is_varied) *entry_of(worker.seen) = true;
}

ShownColors SurfaceShader::shown() const {
  ShownColors all;
  for (const Worker& worker : workers_) all.add(worker.shown);
  // If enough is visible, no reasons for black pixels are needed.
  if (static_cast<double>(all.visible) >= enough_visible()) return all;
  for (const Worker& worker : workers_)
    for (std::size_t id = 0; id < worker.dark_pixels.size(); ++id)
      if (const std::uint32_t count = worker.dark_pixels[id]; count > 0)
        all.add(dark_surface(made_surface(triangles_[id])), count, setup_.lighting, is_lit());
  return all;
}

DarkSurface SurfaceShader::dark_surface(const Surface& surface) const {
  DarkSurface dark = {surface.greatest_channel};
  if (!is_lit()) return dark;
  dark.material = setup_.materials[surface.material];
  const Lighting& lighting = setup_.lighting;
  std::array<SurfacePoint, 3> points = surface.corners;
  if (setup_.model == ShadingModel::flat) points.fill(middle(points));
  for (const SurfacePoint& point : points) {
    const Vec3& p = point.position;
    const Vec3 to_eye = lighting.is_perspective ? unit_vector(scaled(p, -1)) : Vec3{0, 0, 1};
    lit_color(point, lighting, {}, to_eye, [&](std::size_t number) {
      const Light& light = lighting.lights[number];
      dark.light_in_front = dark.light_arriving = std::max(dark.light_in_front, largest_in(light.intensity));
      dark.part_left =
          std::max(dark.part_left, lighting.attenuation.part_left(difference(light.position, p)));
      return Vec3();
    });
  }
  return dark;
}

bool SurfaceShader::is_plane() const {
  constexpr double kFlat = 1e-4;  // more than the decimals of a text lose
  Vec3 normal;                    // of length 1 once it is set
  double offset = 0;
  for (std::size_t id = 0; id < triangles_.size(); ++id) {
    const auto has_seen = [id](const Worker& worker) { return id < worker.seen.size() && worker.seen[id]; };
    if (std::ranges::none_of(workers_, has_seen)) continue;
    Triangle p;
    for (std::size_t v = 0; v < 3; ++v) {  // a point behind the eye lies in the plane as well
      const VertexLine& corner = triangles_[id].corners[v];
      p[v] = triangles_[id].is_divided ? corner.position : scaled(corner.position, 1 / corner.w);
    }
    if (normal == Vec3() && face_normal(p) != Vec3()) {
      normal = unit_vector(face_normal(p));
      offset = dot(normal, p[0]);
    }
    for (const Vec3& corner : p)
      if (!(std::fabs(dot(normal, corner) - offset) <= kFlat * std::max(1.0, largest_in(corner))))
        return false;
  }
  return true;
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
