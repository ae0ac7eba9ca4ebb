#include "tools/rim/empty_picture_note.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <utility>
#include <vector>

#include "libpipeline/text/error.h"

namespace pipeline {
namespace {

/// "the triangle", "all 2 triangles".
std::string all_of(std::uint64_t count, const std::string& thing) {
  return count == 1 ? "the " + thing : "all " + counted(count, thing);
}

std::string all_triangles(std::uint64_t count) {
  return all_of(count, "triangle");
}

const char* are(std::uint64_t count) {
  return count == 1 ? "is " : "are ";
}

/// With four digits, or as many as it takes to show on which side of `limit` the value lies.
std::string rounded(double value, double limit) {
  std::array<char, 32> text{};
  for (int digits = 4; digits <= 17; ++digits) {
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    const double shown = std::strtod(text.data(), nullptr);
    if ((shown < limit) == (value < limit) && (shown > limit) == (value > limit)) break;
  }
  return text.data();
}

std::string rounded(double value) {
  return rounded(value, value < 0 ? value - 1 : value + 1);
}

/// "x from -3 to -1.5", or "x is 2".
std::string range(char axis, double low, double high, double limit) {
  const std::string from = rounded(low, limit), to = rounded(high, limit);
  return axis + (from == to ? " is " + from : " from " + from + " to " + to);
}

std::string window(double limit) {
  return "the window from " + rounded(limit) + " to " + rounded(-limit);
}

/// "(z is 0.6, the limit of the config is 0.5)"; or, if the limit is a plane of the camera, "(z is 0.6, the
/// limit is 0.5, the camera's near)".
std::string beside_limit(double low, double high, double limit, bool is_plane, const char* plane,
                         const char* space = "") {
  return "(" + range('z', low, high, limit) + space + ", the limit " + (is_plane ? "" : "of the config ") +
         "is " + rounded(limit) + (is_plane ? std::string(", the camera's ") + plane : "") + ")";
}

std::string where(UnseenReason reason, const BoundingBox& extent, const Viewport& screen) {
  const auto& [low, high] = extent;
  const double left = screen.left, bottom = screen.bottom;
  switch (reason) {
    case UnseenReason::before_front:
      return "before the front limit " +
             beside_limit(low.z, high.z, screen.front, screen.front == -1, "near");
    case UnseenReason::beyond_rear:
      if (low.z == 1 && high.z == 1 && screen.rear == 1)  // the limit itself, which belongs to no pixel
        return "at the camera's far, which shows nothing (z is 1, perhaps rounded: a near that is too close "
               "to the eye leaves z no digits)";
      return "beyond the rear limit " + beside_limit(low.z, high.z, screen.rear, screen.rear == 1, "far");
    case UnseenReason::left:
      return "left of the window (" + range('x', low.x, high.x, left) + ", " + window(left) + ")";
    case UnseenReason::right:
      return "right of the window (" + range('x', low.x, high.x, -left) + ", " + window(left) + ")";
    case UnseenReason::below:
      return "below the window (" + range('y', low.y, high.y, bottom) + ", " + window(bottom) + ")";
    case UnseenReason::above:
      return "above the window (" + range('y', low.y, high.y, -bottom) + ", " + window(bottom) + ")";
    case UnseenReason::without_area:
      return "without area on the screen, as when seen edge-on";
    case UnseenReason::between_centers:
      break;
  }
  return "between pixel centers (a pixel is " + rounded(screen.dx()) + " by " + rounded(screen.dy()) + ")";
}

std::string behind_eye(double low, double high) {
  return "behind the eye (" + range('z', low, high, 0) +
         " in view space; the camera looks down -z: turn it around, or move it back by more than " +
         rounded(high) + ")";
}

std::string where(OutsidePart part, const BoundingBox& extent) {
  const auto& [low, high] = extent;
  switch (part) {
    case OutsidePart::behind:
      return behind_eye(low.z, high.z);
    case OutsidePart::near:
      return "nearer than the near plane (" + range('z', low.z, high.z, 0) + ")";
    case OutsidePart::far:
      return "beyond the far plane (" + range('z', low.z, high.z, 0) + ")";
    case OutsidePart::left:
      return "left of the view volume";
    case OutsidePart::right:
      return "right of the view volume";
    case OutsidePart::below:
      return "below the view volume";
    case OutsidePart::above:
      break;
  }
  return "above the view volume";
}

std::string where(SpherePlace place, const UnseenSpheres& spheres) {
  const auto& [count, low, high] = spheres.groups[static_cast<std::size_t>(place)];
  switch (place) {
    case SpherePlace::behind:
      return behind_eye(low, high);
    case SpherePlace::before_front:
      return "before the front limit " +
             beside_limit(low, high, spheres.front, spheres.front_is_near, "near", " in view space");
    case SpherePlace::beyond_rear:
      return "beyond the rear limit " +
             beside_limit(low, high, spheres.rear, spheres.rear_is_far, "far", " in view space");
    case SpherePlace::left:
      return "left of the window";
    case SpherePlace::right:
      return "right of the window";
    case SpherePlace::below:
      return "below the window";
    case SpherePlace::above:
      return "above the window";
    case SpherePlace::elsewhere:
      break;
  }
  return "met by no ray between the limits of Z";
}

/// Some triangles, and where they are.
using Group = std::pair<std::uint64_t, std::string>;

/// "all 3 triangles are behind the eye", or "none of 3 triangles is left: 2 behind the eye, 1 culled".
std::string list_of(const std::vector<Group>& groups, const std::string& none_of,
                    const std::string& thing = "triangle") {
  if (groups.size() == 1)
    return all_of(groups[0].first, thing) + " " + are(groups[0].first) + groups[0].second;
  std::uint64_t count = 0;
  std::string list;
  for (const auto& [group_count, place] : groups) {
    count += group_count;
    list += (list.empty() ? ": " : ", ") + std::to_string(group_count) + " " + place;
  }
  return "none of " + counted(count, thing) + " " + none_of + list;
}

double greatest_of(Vec3 channels) {
  return std::max({channels.x, channels.y, channels.z});
}

/// True for whole channels up to 255, one of them so large that no intensity of light would be.
bool is_like_color(Vec3 channels) {
  const auto is_whole = [](double channel) { return channel == std::floor(channel); };
  return greatest_of(channels) >= 32 && greatest_of(channels) <= 255 && is_whole(channels.x) &&
         is_whole(channels.y) && is_whole(channels.z);
}

constexpr const char* kReachesTheSeenSide =
    " reaches the side that is seen (put a light on the eye's side; ambient 0.2 0.2 0.2 would show it from "
    "anywhere)";

/// Why no light shows on surfaces whose colors are not black.
std::string reason_of_darkness(const SurfaceShader& shader) {
  const auto& [model, lighting, materials, view, background, wireframe, clipped] = shader.setup();
  const auto is_dark = [](const Material& material) {
    return material.diffuse == 0 && material.specular == 0;
  };
  if (std::ranges::all_of(materials, is_dark))
    return std::string(materials.size() == 1 ? "the material reflects" : "all materials reflect") +
           " no light but the ambient (of 'material KA KD KS N', KD and KS are 0)";
  const auto is_off = [](const Light& light) { return greatest_of(light.intensity) == 0; };
  if (std::ranges::all_of(lighting.lights, is_off))
    return "every light has the intensity 0 (the last three numbers of 'light'; 1 is full)";
  const std::optional<double> in_front = shader.shown().light_in_front;
  if (in_front.value_or(0) == 0)  // trace does not look at each light
    return std::string(in_front ? "no light" : "no light, or too little,") + kReachesTheSeenSide;
  const bool is_weakened = lighting.attenuation.linear != 0 || lighting.attenuation.quadratic != 0 ||
                           lighting.attenuation.constant > 1;
  return "the light on the side that is seen is too weak (its intensity is " + rounded(*in_front) +
         (is_weakened ? ", and attenuation weakens it: '1 0 0' would not)" : "; 1 is full)");
}

bool is_black(Color color) {
  return std::max({color.red(), color.green(), color.blue()}) <= 1;
}

constexpr const char* kColorOfBackground =
    "the picture is empty: what is seen has the color of the background";

std::optional<std::string> black_colors_note(const std::optional<double>& greatest_channel) {
  if (greatest_channel && *greatest_channel == 0) return "the picture is black: every color is 0";
  if (greatest_channel && *greatest_channel <= 1)
    return "the picture is black: every color is within 0 and 1, but channels run from 0 to 255";
  return std::nullopt;
}

}  // namespace

std::string empty_scene_note(std::uint64_t triangle_count, const std::optional<SourceLocation>& scale_by_0) {
  if (triangle_count == 0) return "the picture will be empty: the scene has no triangle";
  return (scale_by_0 ? to_string(*scale_by_0) + ": this scale by 0 leaves " : "") +
         all_triangles(triangle_count) + " without area" +
         (scale_by_0 ? "; 1 keeps a direction as it is" : "");
}

std::string dropped_note(const OutsideCounts& outside, std::uint64_t culled_count) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < kOutsidePartCount; ++i)
    if (const auto& [count, extent] = outside.groups[i]; count > 0)
      groups.emplace_back(count, where(static_cast<OutsidePart>(i), extent));
  if (culled_count > 0) groups.emplace_back(culled_count, "dropped by --cull");
  return "the picture will be empty: " + list_of(groups, "is left");
}

std::string radians_note(double fov_y_degrees, std::uint64_t hidden_count, bool is_filled) {
  return std::string(is_filled ? "no vertex" : "nothing") + " is in view, but with a fovY of " +
         rounded(fov_y_degrees * 180 / std::numbers::pi) + " degrees in place of " + rounded(fov_y_degrees) +
         ", " + (is_filled ? "those of " : "") + counted(hidden_count, "triangle") +
         " would be: angles are in degrees; was this one in radians?";
}

std::optional<std::string> bright_light_note(const Appearance& appearance) {
  const auto note = [](const SourceLocation& location, const char* name, double intensity) {
    return to_string(location) + ": " + name + " of " + rounded(intensity) + " is " + rounded(intensity) +
           " times full light: 1 is full, so divide by 255 if this is a color";
  };
  if (appearance.ambient && is_like_color(appearance.ambient->value))
    return note(appearance.ambient->location, "ambient light", greatest_of(appearance.ambient->value));
  if (appearance.attenuation) return std::nullopt;
  for (const Located<Light>& light : appearance.lights)
    if (is_like_color(light.value.intensity))
      return note(light.location, "a light", greatest_of(light.value.intensity));
  return std::nullopt;
}

std::string unseen_note(const UnseenTriangles& unseen, const Viewport& screen) {
  std::string note = "the picture is empty: ";
  if (unseen.count == 0) return note + "no triangle came";
  std::vector<Group> groups;
  for (std::size_t i = 0; i < kUnseenReasonCount; ++i)
    if (const auto& [count, extent] = unseen.groups[i]; count > 0)
      groups.emplace_back(count, where(static_cast<UnseenReason>(i), extent, screen));
  return note + list_of(groups, "shows");
}

std::string unseen_spheres_note(const UnseenSpheres& spheres) {
  std::vector<Group> groups;
  for (std::size_t i = 0; i < kSpherePlaceCount; ++i)
    if (const std::uint64_t count = spheres.groups[i].count; count > 0)
      groups.emplace_back(count, where(static_cast<SpherePlace>(i), spheres));
  return "the picture is empty: " + list_of(groups, "shows", "sphere");
}

std::optional<std::string> opaque_note(const Appearance& appearance) {
  const auto sends_rays = [](const Located<Material>& material) { return material.value.sends_rays(); };
  if (std::ranges::none_of(appearance.materials, sends_rays)) return std::nullopt;
  return "mirrors and glass are drawn as matt and opaque; trace, in place of project and zbuf, follows the "
         "light";
}

std::optional<std::string> invisible_colors_note(const SurfaceShader& shader) {
  if (shader.shown().show_something) return std::nullopt;
  const SurfaceShader::Setup& setup = shader.setup();
  const bool is_lit = setup.model != ShadingModel::none;
  if (is_black(setup.background)) {
    if (auto note = black_colors_note(shader.shown().greatest_channel)) return note;
    if (is_lit && !setup.wireframe) return "the picture is black: " + reason_of_darkness(shader);
  }
  if (setup.wireframe && !is_lit)
    return "the picture is empty: --wireframe shows edges alone, and none is in sight";
  return kColorOfBackground;
}

std::optional<std::string> invisible_light_note(const ShownLight& shown, Color background, bool is_lit) {
  if (shown.shows_something) return std::nullopt;
  if (is_black(background)) {
    if (shown.is_cut)
      return "the picture is black: rays that may bring light are cut (--max-depth, --min-contribution)";
    if (!shown.greatest_channel)
      return "the picture is black: mirrors and glass alone are seen, and they show a black background";
    if (auto note = black_colors_note(shown.greatest_channel)) return note;
    if (is_lit && !shown.has_facing_light)
      return std::string("the picture is black: no light") + kReachesTheSeenSide;
    if (is_lit && !shown.has_arriving_light)
      return "the picture is black: all that is seen is in shadow (--no-shadows lights it; ambient 0.2 0.2 "
             "0.2 would show it, too)";
    if (is_lit)
      return "the picture is black: the light that arrives is too weak (1 is full), or the materials reflect "
             "none of it (KD and KS are 0)";
  }
  return kColorOfBackground;
}

}  // namespace pipeline
