#include "libpipeline/picture/shown_colors.h"

#include <algorithm>
#include <cstdlib>

namespace pipeline {
namespace {

/// True if colors differ by at most one step in each channel.
bool are_alike(Color a, Color b) {
  const auto alike = [](int p, int q) { return std::abs(p - q) <= 1; };
  return alike(a.red(), b.red()) && alike(a.green(), b.green()) && alike(a.blue(), b.blue()) &&
         alike(a.alpha(), b.alpha());
}

Darkness reason_of(const DarkSurface& surface, const Lighting& lighting, bool is_lit) {
  constexpr double kDimChannel = 40, kLeastDiffuse = 0.05, kStrongLight = 0.5;
  if (!surface.greatest_channel) return surface.has_cut_rays ? Darkness::cut_rays : Darkness::sends_rays;
  if (*surface.greatest_channel == 0) return Darkness::no_color;
  if (*surface.greatest_channel <= 1) return Darkness::unit_color;
  if (*surface.greatest_channel <= kBlackChannel || !is_lit) return Darkness::small_color;
  if (surface.material.diffuse < kLeastDiffuse)
    return surface.material.specular == 0 ? Darkness::no_reflectance : Darkness::highlights_alone;
  if (std::ranges::all_of(lighting.lights, [](const Light& light) { return light.intensity == Vec3(); }))
    return Darkness::no_intensity;
  if (surface.light_in_front == 0) return Darkness::averted;
  if (surface.light_arriving == 0) return Darkness::in_shadow;
  if (lighting.attenuation.weakens() && surface.part_left < kStrongLight) return Darkness::weakened_light;
  if (surface.light_arriving < kStrongLight) return Darkness::weak_light;
  return *surface.greatest_channel <= kDimChannel ? Darkness::small_color : Darkness::grazing_light;
}

}  // namespace

bool ShownColors::add(Color color, Color background, bool is_lit) {
  has_surface = true;
  is_varied |= color != first.value_or(color);
  if (!first) first = color;
  if (is_lit && color == Color(255, 255, 255)) return ++white, false;
  const bool is_black = std::max({color.red(), color.green(), color.blue()}) <= kBlackChannel;
  if (!is_black || !color.is_opaque()) ++(are_alike(color, background) ? as_background : visible);
  return is_black && color.is_opaque();
}

void ShownColors::add(const DarkSurface& surface, std::uint64_t pixel_count, const Lighting& lighting,
                      bool is_lit) {
  const Darkness reason = reason_of(surface, lighting, is_lit);
  auto& [count, greatest] = dark[static_cast<std::size_t>(reason)];
  count += pixel_count;
  // Without light, a triangle whose greatest channel is beyond this is seen where it is darker.
  const double channel = std::min(surface.greatest_channel.value_or(0), is_lit ? 255 : kBlackChannel);
  greatest = std::max(greatest, reason == Darkness::small_color ? channel : surface.light_arriving);
}

void ShownColors::add(const ShownColors& others) {
  visible += others.visible;
  as_background += others.as_background;
  white += others.white;
  for (std::size_t i = 0; i < dark.size(); ++i) {
    dark[i].count += others.dark[i].count;
    dark[i].greatest = std::max(dark[i].greatest, others.dark[i].greatest);
  }
  has_surface |= others.has_surface;
  is_varied |= others.is_varied || (first && others.first && *first != *others.first);
  if (!first) first = others.first;
}

}  // namespace pipeline
