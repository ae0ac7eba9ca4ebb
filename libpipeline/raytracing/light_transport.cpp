#include "libpipeline/raytracing/light_transport.h"

#include <algorithm>

#include "libpipeline/raytracing/refraction.h"

namespace pipeline {
namespace {

double largest(const Vec3& v) {
  return std::max({v.x, v.y, v.z});
}

/// The fraction of light that passes `length` of a material.
Vec3 passed(const Material& material, double length) {
  const auto channel = [&](double absorption) { return absorption == 0 ? 1 : decay(absorption * length); };
  return {channel(material.absorption.x), channel(material.absorption.y), channel(material.absorption.z)};
}

double length(const Vec3& v) {
  return dot(v, unit_vector(v));
}

/// The unit normal, on the ray's side, for mirroring and refracting: the one for shading or, if that puts a
/// ray on the face's wrong side, the face's.
struct Turning {
  Vec3 normal;
  double cosine;
  double ratio;  // of the refractive indices
};

Turning turning(const SurfaceHit& hit, const Vec3& direction, double index) {
  const double ratio = hit.is_front ? 1 / index : index;
  const Vec3 face = hit.is_front ? hit.face_normal : scaled(hit.face_normal, -1);
  const Vec3 n = unit_vector(hit.normal);
  const Vec3 normal = dot(n, face) < 0 ? scaled(n, -1) : n;
  const auto is_fine = [&] {
    if (!(dot(normal, direction) < 0) || !(dot(mirrored(direction, normal), face) > 0)) return false;
    const auto inside = refracted(direction, normal, ratio);
    return !inside || dot(*inside, face) < 0;
  };
  const Vec3& chosen = is_fine() ? normal : face;
  return {chosen, std::clamp(-dot(chosen, direction), 0.0, 1.0), ratio};
}

}  // namespace

void LightTransport::RayCounts::add(const RayCounts& other) {
  for (std::size_t kind = 0; kind < cast.size(); ++kind) cast[kind] += other.cast[kind];
  cut += other.cut;
  largest_cut_weight = std::max(largest_cut_weight, other.largest_cut_weight);
}

Vec3 LightTransport::radiance(const std::optional<RayCaster::Seen>& seen, const Ray& ray) {
  cut_weight_ = 0;
  dark_ = {};
  Path path = {1, 0, 0, 0};
  log(RayKind::primary, path, ray.origin);
  const SurfaceHit hit = seen ? caster_.seen(seen->id, seen->is_from_within, ray) : SurfaceHit();
  const Vec3 color = color_of(hit, ray, path);
  counts_.largest_cut_weight = std::max(counts_.largest_cut_weight, cut_weight_);
  return color;
}

/// The color at a hit, attenuated on the way there; without one, the background.
Vec3 LightTransport::color_of(const SurfaceHit& hit, const Ray& ray, Path path) {
  const bool is_met = hit.id != kNoSurface;
  Vec3 color = setup_.background;
  if (is_met) {
    Vec3 left = {1, 1, 1};
    if (!hit.is_front && setup_.recurses)
      left = passed(material(hit), length(difference(hit.point, ray.origin)));
    path.weight *= largest(left);
    color = product(left, surface_color(hit, ray, path));
  }
  if (log_ == nullptr) return color;
  LoggedRay& entry = (*log_)[path.log_entry];
  entry.brought = color;
  if (is_met) {
    entry.object = caster_.number(hit.id);
    entry.point = hit.point;
    entry.is_front = hit.is_front;
    entry.is_sphere = !caster_.corners(hit.id);
  } else {
    entry.direction = unit_vector(ray.direction);
  }
  return color;
}

Vec3 LightTransport::surface_color(const SurfaceHit& hit, const Ray& ray, const Path& path) {
  const Material& m = material(hit);
  if (!setup_.recurses || !m.sends_rays()) return local_color(hit, ray, path);
  const Vec3 direction = unit_vector(ray.direction);
  const Turning turn = turning(hit, direction, m.index);
  const double fresnel = m.alpha == 1 ? 0 : fresnel_reflectance(turn.ratio, turn.cosine);
  const double local = m.alpha * (1 - m.reflectance);
  const double mirror = m.alpha * m.reflectance + (1 - m.alpha) * fresnel;
  const double through = (1 - m.alpha) * (1 - fresnel);

  const Path onward = {path.weight, path.depth, path.length + length(difference(hit.point, ray.origin)), 0};
  const auto leaving = [&](const Vec3& way) { return SurfaceRay{{hit.point, way}, hit.id, hit.error}; };
  Vec3 color;
  if (local > 0) color = scaled(local_color(hit, ray, path), local);
  if (mirror > 0)
    color = sum(color, follow(RayKind::mirrored, leaving(mirrored(direction, turn.normal)), onward, mirror));
  if (through > 0)
    if (const auto way = refracted(direction, turn.normal, turn.ratio))
      color = sum(color, follow(RayKind::refracted, leaving(*way), onward, through));
  return color;
}

/// The radiance of a ray that starts on a surface, times `share`.
Vec3 LightTransport::follow(RayKind kind, const SurfaceRay& ray, const Path& path, double share) {
  Path next = {path.weight * share, path.depth + 1, path.length, 0};
  const bool is_cut = next.weight < setup_.min_contribution || next.depth > setup_.max_depth;
  log(kind, next, ray.ray.origin);
  if (is_cut) {
    if (log_ != nullptr) log_->back().is_cut = true;
    ++counts_.cut;
    dark_.has_cut_rays = true;
    cut_weight_ += next.weight;
    return {};
  }
  ++counts_.cast[static_cast<std::size_t>(kind)];
  return scaled(color_of(caster_.nearest(ray), ray.ray, next), share);
}

/// The color as SurfaceShader lights it, but with the light that arrives. For secondary rays, the eye lies
/// straight back from the start, by the path's length.
Vec3 LightTransport::local_color(const SurfaceHit& hit, const Ray& ray, const Path& path) {
  dark_.material = material(hit);
  dark_.greatest_channel = std::max(dark_.greatest_channel.value_or(0), largest(hit.color));
  if (setup_.model == ShadingModel::none) return hit.color;
  const Lighting& lighting = setup_.lighting;
  const Vec3 back = scaled(unit_vector(ray.direction), -1);
  const Vec3 eye = sum(ray.origin, scaled(back, path.length));
  const auto to_eye = [&](const Vec3& p_view) {
    return lighting.is_perspective ? unit_vector(difference(eye, p_view)) : back;
  };
  const auto lit = [&](const SurfacePoint& point) {
    return lit_color(point, lighting, material(hit), to_eye(point.position),
                     [&](std::size_t light) { return part_of_light(hit, light, path); });
  };
  const auto corners = caster_.corners(hit.id);
  if (setup_.model == ShadingModel::phong || !corners) return lit({hit.point, hit.normal, hit.color});
  if (setup_.model == ShadingModel::flat) {
    constexpr std::array<double, 3> kEqual = {1.0 / 3, 1.0 / 3, 1.0 / 3};
    const auto& [a, b, c] = *corners;
    return lit({mean(Triangle{a.position, b.position, c.position}, kEqual), hit.face_normal,
                mean(Triangle{a.color, b.color, c.color}, kEqual)});
  }
  std::array<Vec3, 3> colors;
  for (std::size_t v = 0; v < 3; ++v) colors[v] = clamped_color(lit((*corners)[v]));
  return mean(colors, hit.weights);
}

/// The part of a light that arrives at a hit.
Vec3 LightTransport::part_of_light(const SurfaceHit& hit, std::size_t light, const Path& path) {
  const Light& from = setup_.lighting.lights[light];
  const Vec3 part = setup_.has_shadows ? part_through(hit, from.position) : Vec3{1, 1, 1};
  dark_.light_in_front = std::max(dark_.light_in_front, largest(from.intensity));
  dark_.light_arriving = std::max(dark_.light_arriving, largest(product(part, from.intensity)));
  const Vec3 way = difference(from.position, hit.point);
  dark_.part_left = std::max(dark_.part_left, setup_.lighting.attenuation.part_left(way));
  if (!setup_.has_shadows) return part;
  ++counts_.cast[static_cast<std::size_t>(RayKind::shadow)];
  if (log_ == nullptr) return part;
  Path to_light = {path.weight, path.depth + 1, 0, 0};
  log(RayKind::shadow, to_light, hit.point);
  log_->back().light = light;
  log_->back().brought = part;
  return part;
}

Vec3 LightTransport::part_through(const SurfaceHit& hit, const Vec3& light) {
  const Vec3 way = difference(light, hit.point);
  const auto stops = [&](std::uint32_t number) {
    return !setup_.recurses || setup_.materials[number].alpha == 1;
  };
  if (!caster_.cross({{hit.point, way}, hit.id, hit.error}, crossings_, stops)) return {};
  const double whole_length = length(way);
  Vec3 part = {1, 1, 1};
  double last = 0;
  for (const SurfaceCaster::Crossing& crossing : crossings_) {
    const Material& m = setup_.materials[crossing.material];
    // Both sides use the angle as on the outside, so no total reflection keeps light in a solid.
    part = scaled(part, (1 - m.alpha) * (1 - fresnel_reflectance(1 / m.index, crossing.cosine)));
    if (!crossing.is_front) part = product(part, passed(m, (crossing.t - last) * whole_length));
    last = crossing.t;
  }
  // The light is inside the last body entered.
  if (!crossings_.empty() && crossings_.back().is_front)
    part = product(part, passed(setup_.materials[crossings_.back().material], (1 - last) * whole_length));
  return part;
}

}  // namespace pipeline
